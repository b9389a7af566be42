#pragma once

#include <string>
#include <string_view>

#include <mimicry/embedding/embedding.h>

namespace mimicry {

/// The version that is written; files of another one are refused.
inline constexpr std::uint32_t kEmbeddingFileVersion = 2;

/// The bytes of a `.mimicry` file. All numbers little-endian:
///
///     offset  bytes
///     0       8      "MIMICRY\n"
///     8       4      version
///     12      4      number of sections n
///     16      8      size of the file
///     24      8      checksum of all other bytes
///     32      24 n   sections: 4 bytes name, 4 bytes 0, offset (8), size (8)
///
/// Sections begin at multiples of 64 and hold plain arrays, so that a mapped file can be used where
/// it lies: "META" (numbers, in the order of the source), "FACE" (#F by
/// 3 32-bit vertices of the mesh), "POSI" (#V by 3 doubles), "TETS" (#T by 4
/// 32-bit indices), "VALU" (#V by dimension doubles); and "ORDR" (#F 32-bit faces), which may be
/// missing or empty. Readers pass over sections that they do not know, and META may grow at its
/// end. Not a serialisation library's format: with six flat arrays there is nothing to describe,
/// and a verifier of offsets would still not see a flipped bit.
std::string write_embedding(const Embedding& embedding);

/// The embedding that a file's bytes hold. `name` stands in the error messages only. Throws
/// Error(invalid_input) where the file is not of this format, cut short, damaged (the checksum
/// differs) or contradicts itself (counts, vertex numbers); Error(unsupported) for another version.
/// That it belongs to a mesh is checked by `SmoothProjector`. O(size), about 1 ms for 4
/// MB; memory is that of the arrays, whatever the header claims.
Embedding read_embedding(std::string_view bytes, std::string_view name);

}  // namespace mimicry
