#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/study/recording.h>
#include <mimicry/study/targets.h>

namespace mimicry {

/// Reads a file `<method>_<shape>.json` of the published study (docs/formats.md): its strokes in
/// the order drawn. A stroke that cannot be read comes with `problem` (the piece, the frame and the
/// field), and the others all the same. NaN, Infinity and null in place of a number are NaN. `name`
/// stands for the file in messages. Throws Error(invalid_input) where the text is not JSON (with
/// the byte) or not an array of strokes.
std::vector<RecordedStroke> read_recording(std::string_view bytes, std::string_view name);

/// The same file; reads back to the same bits. P is written as the frames' points. A number that is
/// not finite is written as null.
std::string write_recording(std::span<const RecordedStroke> strokes);

/// Reads `study_sequence.json`. StrokeSequence may be one list for all, a list for each shape, or a
/// list of these for each method, nested or one after the other in a flat list; each with the
/// repeats or without (`with_repeats`); the three may also be parallel lists with an entry
/// for each stroke. Throws Error(invalid_input) saying what does not fit.
StudySequence read_study_sequence(std::string_view bytes, std::string_view name);

/// StrokeSequence is written as a list of lists, repeats included.
std::string write_study_sequence(const StudySequence& sequence);

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

/// A file of target curves as `read_targets` reads it (docs/formats.md), to the same bits. `note`
/// is for its readers.
std::string write_targets(const TargetSet& set, std::string_view note);

}  // namespace mimicry
