#pragma once

#include <string>
#include <string_view>

#include <mimicry/mesh/triangle_mesh.h>

#include "io/attribute_writing.h"

namespace mimicry {

// One writer per format, each in its own source file.
// `note` is told which attributes the format does not hold; it can be called.
std::string write_obj(const TriangleMesh& mesh, std::string_view material_file,
                      const WriteNote& note);
std::string write_off(const TriangleMesh& mesh, const WriteNote& note);
std::string write_ply(const TriangleMesh& mesh, bool text, const WriteNote& note);
std::string write_stl(const TriangleMesh& mesh, bool text);
std::string write_glb(const TriangleMesh& mesh, std::string_view texture_png,
                      const WriteNote& note);

/// Appends three numbers with blanks between.
void append_triple(std::string& out, const Vec3& x);
void append_triple(std::string& out, const Face& face, Index first_number = 0);

/// In single precision; throws Error(invalid_input) where that is not finite.
Eigen::Vector3f to_single(const TriangleMesh& mesh, Index vertex, const char* format,
                          const Vec3& origin = Vec3::Zero());

}  // namespace mimicry
