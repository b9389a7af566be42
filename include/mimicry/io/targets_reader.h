#pragma once

#include <string_view>

#include <mimicry/study/target_set.h>

namespace mimicry {

/// Reads a set of target curves (JSON): {"note": text, "shapes": [{"name", "scale", "curves":
/// [{"face": [#P], "bary": [#P by 3], and optionally "keypoints": [...], "parameters":
/// {"control_points", "k_G", "k_N_degrees"}}]}]}; other members are passed over. Barycentrics are
/// rounded in such files: what is negative or off 1 by at most 1e-3 is clamped and divided by its
/// sum. `name` stands for the file in messages. Throws Error(invalid_input) naming file, shape,
/// curve and point: malformed or truncated JSON (with the byte), a member that is missing or of
/// another kind, arrays of different lengths, a scale that is not positive, barycentrics off by
/// more, key points that do not increase or lie beyond the points. Whether the faces exist only a
/// mesh can tell: `require_fits`.
TargetSet read_targets(std::string_view bytes, std::string_view name);

}  // namespace mimicry
