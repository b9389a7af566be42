#pragma once

#include <optional>
#include <string>
#include <vector>

#include <mimicry/spatial/target.h>
#include <mimicry/study/targets.h>

namespace mimicry::cli {

/// The PNG file of a picture with a panel for each curve, its keypoints as balls. Nothing where the
/// program was built without pictures. up: the axis that points up in it.
std::optional<std::string> contact_sheet(const Target& target,
                                         const std::vector<TargetCurve>& curves, const Vec3& up);

}  // namespace mimicry::cli
