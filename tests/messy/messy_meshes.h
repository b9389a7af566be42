#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry::messy {

/// A kind of mesh that defies algorithms: it crosses itself, has needles or sheets at one place, is
/// not a manifold, or its shape is far from what it looks like from outside.
struct Family {
  std::string_view name;
  /// About `faces` faces (some kinds have steps; "one face" has always one), size about 1.
  TriangleMesh (*make)(Index faces, std::uint64_t seed);
};

/// All of them, in a fixed order.
std::span<const Family> families();

/// Up to 12 vertices and 24 faces that the bytes name, of a coarse grid of positions, so that
/// vertices coincide, faces cross and edges have many faces: for fuzzing. Indices are valid; faces
/// may name a vertex twice.
TriangleMesh of_bytes(std::span<const std::uint8_t> bytes);

}  // namespace mimicry::messy
