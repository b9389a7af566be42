#include "io/gltf_draco.h"

#ifdef MIMICRY_DRACO
#include <draco/compression/config/compression_shared.h>
#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#endif

#include "io/binary.h"
#include "io/gltf_accessor.h"

namespace mimicry {

void fail_without_draco(const GltfJson& gltf, const std::string& place) {
  gltf.fail(place,
            "is compressed with Draco, and this build of mimicry is without that library; build it "
            "where it is installed (Debian: libdraco-dev), or export without compression",
            ErrorKind::unsupported);
}

#ifdef MIMICRY_DRACO

namespace {

[[noreturn]] void fail_damaged(const GltfJson& gltf, const std::string& place) {
  gltf.fail(place, "cannot be decompressed (Draco); it is damaged or of a newer codec");
}

/// Past the metadata, which the decoder skips as well.
bool skip_metadata(draco::DecoderBuffer& buffer, const draco::DracoHeader& header) {
  if ((header.flags & METADATA_FLAG_MASK) == 0) return true;
  draco::GeometryMetadata metadata;
  return draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata);
}

int gltf_component_type(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return kGltfByte;
    case draco::DT_UINT8:
      return kGltfUnsignedByte;
    case draco::DT_INT16:
      return kGltfShort;
    case draco::DT_UINT16:
      return kGltfUnsignedShort;
    case draco::DT_UINT32:
      return kGltfUnsignedInt;
    case draco::DT_FLOAT32:
      return kGltfFloat;
    default:
      return 0;
  }
}

}  // namespace

bool draco_is_built_in() {
  return true;
}

std::size_t draco_face_count(const GltfJson& gltf, std::string_view bytes,
                             const std::string& place) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok() ||
      header.encoder_type != draco::TRIANGULAR_MESH)
    fail_damaged(gltf, place);
  // Before 2.2 counts had another form; glTF asks for 2.2.
  const int version = header.version_major * 256 + header.version_minor;
  if (version < 2 * 256 + 2) fail_damaged(gltf, place);
  buffer.set_bitstream_version(static_cast<std::uint16_t>(version));
  if (!skip_metadata(buffer, header)) fail_damaged(gltf, place);
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
    std::uint8_t traversal = 0;
    if (!buffer.Decode(&traversal) || !draco::DecodeVarint(&first, &buffer) ||
        !draco::DecodeVarint(&second, &buffer))
      fail_damaged(gltf, place);
    first = second;  // the number of vertices comes before
  } else if (!draco::DecodeVarint(&first, &buffer)) {
    fail_damaged(gltf, place);
  }
  // Even flat grids take more; the decoder allocates for all that it is promised.
  constexpr std::size_t kMostPerByte = 1000;
  if (first > kMostPerByte * bytes.size()) fail_damaged(gltf, place);
  return first;
}

DracoMesh decode_draco(const GltfJson& gltf, std::string_view bytes,
                       const std::vector<std::size_t>& ids, const std::string& place) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) fail_damaged(gltf, place);
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();

  DracoMesh out;
  out.points = mesh->num_points();
  out.corners.reserve(std::size_t{12} * mesh->num_faces());
  for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f)
    for (const draco::PointIndex& corner : mesh->face(f))
      append_little_endian(out.corners, static_cast<std::uint32_t>(corner.value()));
  for (const std::size_t id : ids) {
    const draco::PointAttribute* attribute =
        mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
    DracoAttribute& values = out.attributes.emplace_back();
    if (!attribute) continue;
    values.components = static_cast<std::size_t>(attribute->num_components());
    values.component_type = gltf_component_type(attribute->data_type());
    if (values.component_type == 0) continue;
    const auto size =
        values.components * static_cast<std::size_t>(draco::DataTypeLength(attribute->data_type()));
    values.bytes.resize(size * out.points);
    for (std::size_t p = 0; p < out.points; ++p)
      attribute->GetMappedValue(draco::PointIndex(static_cast<std::uint32_t>(p)),
                                values.bytes.data() + size * p);
  }
  return out;
}

#else

bool draco_is_built_in() {
  return false;
}

std::size_t draco_face_count(const GltfJson& gltf, std::string_view, const std::string& place) {
  fail_without_draco(gltf, place);
}

DracoMesh decode_draco(const GltfJson& gltf, std::string_view, const std::vector<std::size_t>&,
                       const std::string& place) {
  fail_without_draco(gltf, place);
}

#endif

}  // namespace mimicry
