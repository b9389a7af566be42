#include "io/glb_chunks.h"

#include <algorithm>
#include <cstdint>

#include <mimicry/base/error.h>

#include "io/binary.h"
#include "io/gltf_json.h"
#include "io/text.h"

namespace mimicry {
namespace {

constexpr std::uint32_t kGlbMagic = 0x46546c67;     // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004e4942;  // "BIN"
constexpr std::size_t kGlbHeader = 12;
constexpr std::size_t kChunkGlbHeader = 8;  // length, type

/// A chunk's header: where it is and what it says.
struct Chunk {
  std::size_t content;  // where its content begins
  std::size_t size;
  std::uint32_t type;
};

std::optional<Chunk> chunk_at(std::string_view bytes, std::size_t offset) {
  if (offset > bytes.size() || bytes.size() - offset < kChunkGlbHeader) return std::nullopt;
  return Chunk{offset + kChunkGlbHeader, load<std::uint32_t>(bytes.data() + offset),
               load<std::uint32_t>(bytes.data() + offset + 4)};
}

std::size_t aligned(std::size_t offset) {
  return (offset + 3) / 4 * 4;
}

/// The binary chunk where the lengths say, or a little off: writers forget the padding, or to
/// count it. `json_end`: where the JSON object ends.
std::optional<Chunk> find_binary(std::string_view bytes, const Chunk& json, std::size_t json_end,
                                 bool& mended) {
  const std::size_t end = json.content + std::min(json.size, bytes.size() - json.content);
  std::size_t offset = end;
  for (int k = 0; k < 16; ++k) {  // chunks of other kinds may stand between
    const auto chunk = chunk_at(bytes, offset);
    if (!chunk || chunk->size > bytes.size() - chunk->content) break;
    if (chunk->type == kBinaryChunk) return chunk;
    offset = chunk->content + chunk->size;
  }
  const auto moved = [&](std::size_t first) {
    const auto chunk = chunk_at(bytes, first);
    return chunk && chunk->type == kBinaryChunk ? chunk : std::nullopt;
  };
  mended = true;
  for (const std::size_t first : {end, aligned(end)})
    if (const auto chunk = moved(first)) return chunk;
  for (std::size_t first = json_end; first < json_end + 16; ++first)
    if (const auto chunk = moved(first)) return chunk;
  return std::nullopt;
}

}  // namespace

bool is_glb(std::string_view bytes) {
  return bytes.size() >= 4 && load<std::uint32_t>(bytes.data()) == kGlbMagic;
}

GlbChunks split_glb(std::string_view bytes, std::string_view name,
                    const std::function<void(const std::string&)>& note) {
  if (bytes.size() < kGlbHeader)
    fail_at_byte(name, bytes.size(), "the file ends within the header of a GLB; it is cut short");
  const auto version = load<std::uint32_t>(bytes.data() + 4);
  if (version != 2)
    throw Error(ErrorKind::unsupported, std::string(name) + ": GLB version " +
                                            std::to_string(version) +
                                            " is not handled; export it as glTF 2.0");
  const auto json = chunk_at(bytes, kGlbHeader);
  if (!json)
    fail_at_byte(name, bytes.size(), "the file ends before its first chunk; it is cut short");
  if (json->type != kJsonChunk)
    fail_at_byte(name, kGlbHeader, "the first chunk is not JSON; export the file again");

  std::string wrong;
  const std::size_t length = load<std::uint32_t>(bytes.data() + 8);
  if (length != bytes.size())
    wrong = "the header counts " + std::to_string(length) + " bytes and the file holds " +
            std::to_string(bytes.size()) + "; all of them were looked at";
  GlbChunks out;
  const std::size_t object = json_object_size(bytes.substr(json->content));
  if (object == 0) {  // broken: the parser tells where
    out.json = bytes.substr(json->content, json->size);
    return out;
  }
  out.json = bytes.substr(json->content, object);
  bool mended = false;
  if (const auto binary = find_binary(bytes, *json, json->content + object, mended)) {
    // To the end of the file: accessors tell how much of it there has to be.
    out.binary = bytes.substr(binary->content);
    if (out.binary->size() < binary->size)
      wrong = "the binary chunk counts " + std::to_string(binary->size) +
              " bytes and the file holds " + std::to_string(out.binary->size()) + " of them";
  } else {
    mended = object > json->size;
  }
  if (note && mended) note("the lengths or the alignment of the GLB's chunks are wrong; mended");
  if (note && !wrong.empty()) note(wrong);
  return out;
}

}  // namespace mimicry
