#pragma once

#include <string>

#include <mimicry/base/error.h>
#include <mimicry/curve/projected_curve.h>
#include <mimicry/io/curves.h>
#include <mimicry/io/strokes.h>
#include <mimicry/mesh/triangle_mesh.h>
#include <mimicry/stroke/stroke.h>
#include <mimicry/study/targets.h>
#include <mimicry/technique/technique.h>

namespace mimicry {

// Files by their names. Readers and writers of bytes are in mimicry/io. Each throws Error(io) where
// the file cannot be read or written.

/// The sound strokes of a `mimicry-strokes` file, and what was left out. Throws Error as
/// `read_strokes` does.
StrokesFile load_strokes(const std::string& path);

/// The target curves of a file. Throws Error as `read_targets` does.
TargetSet load_target_curves(const std::string& path);

/// A curve with what files tell of where it came from: the stroke that it was drawn from, the
/// technique and the options that it was drawn with. It has no radii: its tube has the file's.
CurveRecord curve_record(const Stroke& stroke, const TechniqueInfo& technique, ProjectedCurve curve,
                         const TechniqueOptions& options = {});

/// Writes curves on a mesh, in the format that the file's ending names: .json (all that is known of
/// them, read back by `read_curves_json`), .obj and .csv (points), .glb and .ply (tubes of 0.3 % of
/// the mesh's diagonal, in the techniques' colours). The file is whole, old or new, whatever
/// happens. Throws Error(unsupported) for another ending.
void save_curves(const std::string& path, const CurveSet& set, const TriangleMesh& mesh);

}  // namespace mimicry
