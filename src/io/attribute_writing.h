#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// What a writer says of what its format does not hold.
using WriteNote = std::function<void(const std::string&)>;

/// For each vertex the number of its value, kNone where no corner has one; nothing where corners of
/// one vertex have different values, or some have none. mesh: with `values`.
template <std::size_t N>
std::optional<std::vector<Index>> values_of_vertices(const TriangleMesh& mesh,
                                                     const CornerValues<N>& values);

extern template std::optional<std::vector<Index>> values_of_vertices(const TriangleMesh&,
                                                                     const CornerValues<2>&);
extern template std::optional<std::vector<Index>> values_of_vertices(const TriangleMesh&,
                                                                     const CornerValues<4>&);

/// A colour's components encoded as in sRGB, alpha as it is; each the double that reads back as the
/// same linear number.
std::array<double, 4> encoded_color(const std::array<float, 4>& linear);
/// The same as bytes; nothing where bytes do not hold it.
std::optional<std::array<unsigned char, 4>> color_bytes(const std::array<float, 4>& linear);
/// All of them, or nothing.
std::optional<std::vector<std::array<unsigned char, 4>>> color_bytes(
    const std::vector<std::array<float, 4>>& linear);

/// A name as it stands behind a keyword: one line without blanks around it.
std::string label_text(const std::string& name);

}  // namespace mimicry
