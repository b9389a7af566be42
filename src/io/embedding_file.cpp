#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

#include <mimicry/base/error.h>
#include <mimicry/io/embedding_file.h>

#include "io/binary.h"

namespace mimicry {
namespace {

constexpr std::string_view kMagic = "MIMICRY\n";
constexpr std::size_t kHeader = 32, kEntry = 24, kAlignment = 64;
constexpr std::size_t kMostSections = 64;

static_assert(sizeof(Vec3) == 24 && sizeof(Face) == 12 && sizeof(std::array<Index, 4>) == 16);
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr bool kComparesChecksum = false;
#else
constexpr bool kComparesChecksum = true;
#endif
constexpr bool kIsLittleEndian = std::endian::native == std::endian::little;

// Four chains of multiply and rotate over 8-byte words, one for each word of a block of 32, so that
// they overlap in the processor; each step can be undone, so that no single change is lost.
std::uint64_t checksum(std::string_view bytes) {
  constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15U;
  std::array<std::uint64_t, 4> state = {1, 2, 3, bytes.size()};
  const auto mix = [&](std::uint64_t s, std::uint64_t word) {
    s = (s ^ word) * kFactor;
    return s << 29 | s >> 35;
  };
  std::size_t at = 0;
  for (; at + 32 <= bytes.size(); at += 32)
    for (std::size_t k = 0; k < 4; ++k)
      state[k] = mix(state[k], load<std::uint64_t>(bytes.data() + at + 8 * k));
  std::array<char, 32> rest = {};
  std::memcpy(rest.data(), bytes.data() + at, bytes.size() - at);
  for (std::size_t k = 0; k < 4; ++k)
    state[k] = mix(state[k], load<std::uint64_t>(rest.data() + 8 * k));
  std::uint64_t result = 0;
  for (const std::uint64_t s : state) result = mix(result, s);
  return result ^ result >> 32;
}

// Of everything but itself.
std::uint64_t file_checksum(std::string_view head, std::string_view body) {
  return checksum(head.substr(0, 24)) + checksum(body);
}

// The numbers of META, in one order for both directions.
template <class Visit>
void each_number(auto& e, Visit&& visit) {
  auto& q = e.quality;
  visit(e.mesh_hash);
  visit(e.diagonal);
  visit(e.dimension);
  visit(e.mesh_vertex_count);
  visit(e.options.dimension);
  visit(e.options.samples);
  visit(e.options.offset);
  visit(q.is_lattice);
  visit(q.hit_a_cap);
  visit(q.surface_first);
  visit(q.shell_rounds);
  visit(q.added_vertices);
  visit(q.missing_edges);
  visit(q.pierced_faces);
  visit(q.crossing_faces);
  visit(q.joined_vertices);
  visit(q.samples);
  visit(q.mds_iterations);
  visit(q.ls_mesh_iterations);
  visit(q.stress);
  for (auto& d : q.distortion) visit(d);
  visit(q.sliver_percent);
  visit(e.overlapping_tets);
}

template <class T>
std::string array_bytes(const T* numbers, std::size_t count) {
  std::string out;
  if constexpr (kIsLittleEndian) {
    out.assign(reinterpret_cast<const char*>(numbers), count * sizeof(T));
  } else {
    for (std::size_t i = 0; i < count; ++i) append_little_endian(out, numbers[i]);
  }
  return out;
}

template <class T>
void read_array(std::string_view bytes, T* numbers) {
  if (bytes.empty()) return;
  if constexpr (kIsLittleEndian) {
    std::memcpy(numbers, bytes.data(), bytes.size());
  } else {
    for (std::size_t i = 0; i < bytes.size() / sizeof(T); ++i)
      numbers[i] = load<T>(bytes.data() + i * sizeof(T));
  }
}

class Reader {
 public:
  Reader(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {
    if (bytes.size() < kMagic.size() || bytes.substr(0, kMagic.size()) != kMagic)
      refuse("it does not begin as an embedding file (.mimicry); give one that mimicry bake wrote");
    if (bytes.size() < kHeader) refuse("it is cut short in its header; bake again");
    const auto version = load<std::uint32_t>(bytes.data() + 8);
    if (version != kEmbeddingFileVersion)
      throw Error(ErrorKind::unsupported,
                  std::string(name) + ": embedding file of version " + std::to_string(version) +
                      ", this program reads version " + std::to_string(kEmbeddingFileVersion) +
                      "; bake again or use a newer program");
    const auto size = load<std::uint64_t>(bytes.data() + 16);
    if (size != bytes.size())
      refuse("it has " + std::to_string(bytes.size()) + " bytes, its header says " +
             std::to_string(size) + "; bake again");
    if (kComparesChecksum &&
        load<std::uint64_t>(bytes.data() + 24) != file_checksum(bytes, bytes.substr(kHeader)))
      refuse("it is damaged (its checksum differs); bake again");
    count_ = load<std::uint32_t>(bytes.data() + 12);
    if (count_ > kMostSections || kHeader + count_ * kEntry > bytes.size())
      refuse("its " + std::to_string(count_) + " sections do not fit in it; bake again");
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(ErrorKind::invalid_input, std::string(name_) + ": " + what);
  }

  // Of whole elements of `element` bytes.
  std::string_view section(std::string_view wanted, std::size_t element) const {
    if (const auto found = optional_section(wanted, element)) return *found;
    refuse("section " + std::string(wanted) + " is missing; bake again");
  }
  std::optional<std::string_view> optional_section(std::string_view wanted,
                                                   std::size_t element) const {
    for (std::size_t i = 0; i < count_; ++i) {
      const char* entry = bytes_.data() + kHeader + i * kEntry;
      if (std::string_view(entry, 4) != wanted) continue;
      const auto offset = load<std::uint64_t>(entry + 8), size = load<std::uint64_t>(entry + 16);
      if (offset > bytes_.size() || size > bytes_.size() - offset || size % element != 0)
        refuse("section " + std::string(wanted) + " does not fit in it; bake again");
      return bytes_.substr(offset, size);
    }
    return std::nullopt;
  }

 private:
  std::string_view bytes_, name_;
  std::size_t count_ = 0;
};

}  // namespace

std::string write_embedding(const Embedding& e) {
  std::string meta;
  each_number(e, [&](const auto& x) {
    if constexpr (std::is_same_v<std::decay_t<decltype(x)>, bool>)
      append_little_endian(meta, static_cast<std::int32_t>(x));
    else
      append_little_endian(meta, x);
  });
  const std::array<std::pair<std::string_view, std::string>, 6> sections = {
      {{"META", std::move(meta)},
       {"FACE", array_bytes(e.faces.empty() ? nullptr : e.faces[0].data(), 3 * e.faces.size())},
       {"POSI",
        array_bytes(e.positions.empty() ? nullptr : e.positions[0].data(), 3 * e.positions.size())},
       {"TETS", array_bytes(e.tets.empty() ? nullptr : e.tets[0].data(), 4 * e.tets.size())},
       {"VALU", array_bytes(e.values.data(), e.values.size())},
       {"ORDR", array_bytes(e.face_order.data(), e.face_order.size())}}};

  const auto aligned = [](std::size_t at) {
    return (at + kAlignment - 1) / kAlignment * kAlignment;
  };
  std::string table, body;
  std::size_t at = aligned(kHeader + sections.size() * kEntry);
  for (const auto& [name, bytes] : sections) {
    table += name;
    append_little_endian(table, std::uint32_t{0});
    append_little_endian(table, static_cast<std::uint64_t>(at));
    append_little_endian(table, static_cast<std::uint64_t>(bytes.size()));
    at = aligned(at + bytes.size());
  }
  body = table;
  body.reserve(at - kHeader);
  for (const auto& [name, bytes] : sections) {
    body.resize(aligned(kHeader + body.size()) - kHeader, '\0');
    body += bytes;
  }
  std::string out(kMagic);
  append_little_endian(out, kEmbeddingFileVersion);
  append_little_endian(out, static_cast<std::uint32_t>(sections.size()));
  append_little_endian(out, static_cast<std::uint64_t>(kHeader + body.size()));
  append_little_endian(out, file_checksum(out, body));
  return out + body;
}

Embedding read_embedding(std::string_view bytes, std::string_view name) {
  const Reader reader(bytes, name);
  Embedding e;
  const std::string_view meta = reader.section("META", 1);
  std::size_t at = 0;
  const auto take = [&]<class T>() {
    if (meta.size() - at < sizeof(T)) reader.refuse("section META is cut short; bake again");
    const T value = load<T>(meta.data() + at);
    at += sizeof(T);
    return value;
  };
  each_number(e, [&](auto& x) {
    using T = std::decay_t<decltype(x)>;
    if constexpr (std::is_same_v<T, bool>)
      x = take.template operator()<std::int32_t>() != 0;
    else
      x = take.template operator()<T>();
  });
  const std::string_view faces = reader.section("FACE", sizeof(Face));
  const std::string_view positions = reader.section("POSI", sizeof(Vec3));
  const std::string_view tets = reader.section("TETS", sizeof(std::array<Index, 4>));
  const std::string_view values = reader.section("VALU", sizeof(double));
  const std::size_t vertices = positions.size() / sizeof(Vec3);
  constexpr std::size_t kMost = std::numeric_limits<Index>::max();
  if (e.dimension < 1 || e.mesh_vertex_count < 0 || vertices > kMost ||
      faces.size() / sizeof(Face) > kMost / 3 ||
      static_cast<std::size_t>(e.mesh_vertex_count) > vertices ||
      tets.size() / sizeof(std::array<Index, 4>) > kMost ||
      values.size() / sizeof(double) != vertices * static_cast<std::size_t>(e.dimension))
    reader.refuse("its counts contradict each other; bake again");
  e.faces.resize(faces.size() / sizeof(Face));
  if (!e.faces.empty()) read_array(faces, e.faces[0].data());
  e.positions.resize(vertices);
  if (vertices > 0) read_array(positions, e.positions[0].data());
  e.tets.resize(tets.size() / sizeof(std::array<Index, 4>));
  if (!e.tets.empty()) read_array(tets, e.tets[0].data());
  e.values.resize(values.size() / sizeof(double));
  read_array(values, e.values.data());
  for (std::size_t f = 0; f < e.faces.size(); ++f)
    for (const Index v : e.faces[f])
      if (v < 0 || v >= e.mesh_vertex_count)
        reader.refuse("face " + std::to_string(f) + " refers to vertex " + std::to_string(v) +
                      ", which the mesh does not have; bake again");
  for (std::size_t t = 0; t < e.tets.size(); ++t) {
    std::uint32_t largest = 0;
    for (const Index v : e.tets[t]) largest = std::max(largest, static_cast<std::uint32_t>(v));
    if (largest >= vertices)
      reader.refuse("tetrahedron " + std::to_string(t) + " refers to vertex " +
                    std::to_string(static_cast<Index>(largest)) +
                    ", which does not exist; bake again");
  }
  if (const auto order = reader.optional_section("ORDR", sizeof(Index))) {
    e.face_order.resize(order->size() / sizeof(Index));
    read_array(*order, e.face_order.data());
  }
  return e;
}

}  // namespace mimicry
