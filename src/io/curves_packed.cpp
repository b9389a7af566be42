#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/io/curves.h>
#include <mimicry/mesh/connect.h>

#include "io/binary.h"

namespace mimicry {
namespace {

// Its first byte begins no text: in UTF-8 it is the middle of a letter.
constexpr std::string_view kPackedMagic = "\x93mimicry-curves\x01";

class Packer {
 public:
  static constexpr bool kReads = false;
  std::string out{kPackedMagic};

  void u32(const std::uint32_t& value) { append_little_endian(out, value); }
  void f64(const double& value) { append_little_endian(out, value); }
  std::size_t count(std::size_t size, std::size_t) {
    u32(static_cast<std::uint32_t>(size));
    return size;
  }
  void text(const std::string& value) {
    count(value.size(), 1);
    out += value;
  }
};

class Unpacker {
 public:
  static constexpr bool kReads = true;

  Unpacker(std::string_view bytes, std::string name) : rest_(bytes), name_(std::move(name)) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::invalid_input, name_ + ": " + what);
  }
  void u32(std::uint32_t& value) { value = load<std::uint32_t>(take(4)); }
  void f64(double& value) {
    value = load<double>(take(8));
    if (!std::isfinite(value)) fail("holds a number that is not finite; use another copy");
  }
  // Of things that take at least so many bytes each: no more than there can be.
  std::size_t count(std::size_t, std::size_t bytes_each) {
    std::uint32_t size = 0;
    u32(size);
    if (size > rest_.size() / bytes_each) ends_early();
    return size;
  }
  void text(std::string& value) {
    const std::size_t size = count(0, 1);
    value.assign(take(size), size);
  }
  bool is_at_end() const { return rest_.empty(); }

 private:
  [[noreturn]] void ends_early() const { fail("the content ends early; use another copy"); }
  const char* take(std::size_t size) {
    if (size > rest_.size()) ends_early();
    const char* const at = rest_.data();
    rest_.remove_prefix(size);
    return at;
  }

  std::string_view rest_;
  std::string name_;
};

// The layout, said once for both directions.

template <class Archive>
void pass_index(Archive& archive, auto& value) {
  auto bits = static_cast<std::uint32_t>(value);
  archive.u32(bits);
  if constexpr (Archive::kReads) value = static_cast<Index>(bits);
}

template <class Archive>
void pass_vector(Archive& archive, auto& values) {
  for (int k = 0; k < 3; ++k) archive.f64(values[k]);
}

template <class Archive>
void pass_list(Archive& archive, auto& values, std::size_t bytes_each, auto&& each) {
  const std::size_t size = archive.count(values.size(), bytes_each);
  if constexpr (Archive::kReads) values.resize(size);
  for (auto& value : values) each(value);
}

template <class Archive>
void pass_options(Archive& archive, auto& all) {
  const auto values_of = [&](auto& values) {
    pass_list(archive, values, 8, [&](auto& value) { archive.f64(value); });
  };
  const std::size_t size = archive.count(all.size(), 8);
  if constexpr (Archive::kReads) {
    for (std::size_t i = 0; i < size; ++i) {
      std::string name;
      archive.text(name);
      values_of(all[name]);
    }
  } else {
    for (const auto& [name, values] : all) {
      archive.text(name);
      values_of(values);
    }
  }
}

template <class Archive>
void pass_curve(Archive& archive, auto& curve) {
  std::uint32_t closed = curve.closed;
  archive.u32(closed);
  if constexpr (Archive::kReads) curve.closed = closed != 0;
  pass_list(archive, curve.points, 96, [&](auto& p) {
    pass_index(archive, p.surface.face);
    pass_index(archive, p.frame);
    pass_vector(archive, p.surface.bary);
    pass_vector(archive, p.position);
    pass_vector(archive, p.normal);
    archive.f64(p.time_s);
    archive.f64(p.pen_distance);
  });
  pass_list(archive, curve.pieces, 16, [&](auto& piece) {
    auto kind = static_cast<std::uint32_t>(piece.kind);
    archive.u32(kind);
    archive.u32(piece.crossing_count);
    archive.f64(piece.length);
    if constexpr (Archive::kReads) {
      if (kind > static_cast<std::uint32_t>(PieceKind::gap))
        archive.fail("a piece's kind is not known; use another copy");
      piece.kind = static_cast<PieceKind>(kind);
    }
  });
  pass_list(archive, curve.crossings, 12, [&](auto& crossing) {
    pass_index(archive, crossing.half_edge);
    archive.f64(crossing.t);
  });
}

template <class Archive>
void pass_record(Archive& archive, auto& record) {
  archive.text(record.stroke);
  archive.text(record.technique);
  pass_options(archive, record.options);
  auto& place = record.model_to_world;
  for (int k = 0; k < 4; ++k) archive.f64(place.rotation.coeffs()[k]);
  pass_vector(archive, place.translation);
  archive.f64(place.scale);
  pass_curve(archive, record.curve);
}

// Faces and half-edges by the mesh's own numbers, as in every file.
void to_source(ProjectedCurve& curve, const TriangleMesh& mesh) {
  for (CurvePoint& p : curve.points) p.surface = source_point(mesh, p.surface);
  for (Crossing& c : curve.crossings) c = source_crossing(mesh, c);
}

// Throws where the curve cannot be one on the mesh.
void check_curve(const Unpacker& from, ProjectedCurve& curve, const TriangleMesh& mesh) {
  const auto beyond = [](Index i, Index count) { return i < 0 || i >= count; };
  for (const CurvePoint& p : curve.points) {
    if (beyond(p.surface.face, mesh.face_count()) || p.frame < 0)
      from.fail("a point is beyond the mesh; it is not the mesh that was drawn on");
    const Vec3& b = p.surface.bary;
    if (std::abs(b[0]) > 2.0 || std::abs(b[1]) > 2.0 || std::abs(b[2]) > 2.0 ||
        std::abs(b.sum() - 1.0) > 1e-6 || b.minCoeff() < -1e-6)
      from.fail("barycentrics are not three numbers >= 0 that sum to 1; use another copy");
  }
  for (const Crossing& c : curve.crossings)
    if (beyond(c.half_edge, 3 * mesh.face_count()) || !(c.t >= 0.0 && c.t <= 1.0))
      from.fail("a crossing is beyond the mesh; it is not the mesh that was drawn on");
  std::uint64_t crossings = 0;
  for (Piece& piece : curve.pieces) {
    piece.first_crossing = static_cast<std::uint32_t>(crossings);
    crossings += piece.crossing_count;
  }
  if (crossings != curve.crossings.size() ||
      curve.pieces.size() + 1 != std::max<std::size_t>(curve.points.size(), 1))
    from.fail("pieces do not fit the points; use another copy");
  if (curve.closed && !curve.points.empty()) {
    const SurfacePoint& first = curve.points.front().surface;
    const SurfacePoint& last = curve.points.back().surface;
    if (first.face != last.face || first.bary != last.bary)
      from.fail("a closed curve does not end in its first point; use another copy");
  }
}

}  // namespace

std::string write_curves_packed(const CurveSet& set, const TriangleMesh& mesh) {
  Packer packer;
  const Index vertices = source_vertex_count(mesh), faces = mesh.face_count();
  pass_index(packer, vertices);
  pass_index(packer, faces);
  packer.text(set.target);
  packer.count(set.curves.size(), 1);
  for (CurveRecord record : set.curves) {
    to_source(record.curve, mesh);
    pass_record(packer, record);
  }
  return std::move(packer.out);
}

bool is_packed_curves(std::string_view bytes) {
  return bytes.substr(0, kPackedMagic.size() - 1) ==
         kPackedMagic.substr(0, kPackedMagic.size() - 1);
}

CurveSet read_curves_packed(std::string_view bytes, std::string_view name,
                            const TriangleMesh& mesh) {
  const std::string file(name);
  if (!is_packed_curves(bytes))
    throw Error(ErrorKind::invalid_input, file + ": holds no packed curves");
  if (!bytes.starts_with(kPackedMagic))
    throw Error(ErrorKind::unsupported,
                file + ": packed curves of another version; update the program");
  Unpacker from(bytes.substr(kPackedMagic.size()), file);
  Index vertices = 0, faces = 0;
  pass_index(from, vertices);
  pass_index(from, faces);
  CurveSet set;
  from.text(set.target);
  if (vertices != source_vertex_count(mesh) || faces != mesh.face_count())
    from.fail("was drawn on a mesh of " + std::to_string(vertices) + " vertices and " +
              std::to_string(faces) + " faces; this one has " +
              std::to_string(source_vertex_count(mesh)) + " and " +
              std::to_string(mesh.face_count()));
  constexpr std::size_t kLeastRecord = 92;
  set.curves.resize(from.count(0, kLeastRecord));
  for (CurveRecord& record : set.curves) {
    pass_record(from, record);
    check_curve(from, record.curve, mesh);
    to_source(record.curve, mesh);
  }
  if (!from.is_at_end()) from.fail("something follows the curves; use another copy");
  return set;
}

}  // namespace mimicry
