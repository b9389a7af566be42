#pragma once

#include <string_view>

#include <mimicry/embedding/embedding.h>

namespace mimicry {

/// A text of an embedding: vertices with their positions in space and in R^8, and elements.
struct EmbeddingText {
  std::vector<Vec3> positions;  ///< #V by 3
  std::vector<double> values;   ///< #V by 8
  std::vector<Index> elements;  ///< `corners` numbers each
};

/// Reads the text format of the published implementation of Panozzo et al.'s weighted averages: a
/// line with the number of vertices, one with that of elements; for each vertex a line with its
/// position (3 numbers) and one with its position in R^8 (8 numbers); for each element a line with
/// its vertices, counted from 0: `corners` of them, 3 for a surface, 4 for a shell. Empty lines are
/// passed over. Throws Error(invalid_input), with the line, where the text ends early or goes on
/// after its last element, a line holds another number of numbers, a number is not finite or beyond
/// 1e30, or an element refers to a vertex that does not exist. O(size).
EmbeddingText read_embedding_text(std::string_view bytes, std::string_view name, int corners);

/// The embedding of a surface (elements of 3) and its shell (elements of 4), which share no
/// numbering: where the shell's first vertices are the surface's they are kept once, otherwise the
/// surface's stand before them. Tetrahedra are turned to positive orientation. Values are centred;
/// the quality's slivers are measured, and its samples are 0: nothing is known of stress. Throws
/// Error(invalid_input) where the surface has no faces or the shell no tetrahedra.
Embedding make_embedding(EmbeddingText surface, EmbeddingText shell);

}  // namespace mimicry
