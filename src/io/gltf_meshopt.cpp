#include "io/gltf_meshopt.h"

#ifdef MIMICRY_MESHOPT
#include <meshoptimizer.h>
#endif

#include "io/text.h"

namespace mimicry {

void fail_without_meshopt(const GltfJson& gltf, const std::string& place) {
  gltf.fail(place,
            "is compressed with meshopt, and this build of mimicry is without meshoptimizer; build "
            "it where that is installed (Debian: libmeshoptimizer-dev), or export without "
            "compression",
            ErrorKind::unsupported);
}

#ifdef MIMICRY_MESHOPT

namespace {

std::string word(const Json& object, const char* key, const char* otherwise) {
  const Json* value = GltfJson::find(object, key);
  return value && value->is_string() ? value->get<std::string>() : otherwise;
}

}  // namespace

bool meshopt_is_built_in() {
  return true;
}

std::string decode_meshopt(const GltfJson& gltf, const Json& extension, std::string_view bytes,
                           const std::string& place) {
  // What the library asserts of its arguments is checked here; it copes with any bytes.
  const std::size_t count = gltf.whole(extension, "count", place);
  const std::size_t stride = gltf.whole(extension, "byteStride", place);
  const std::string mode = word(extension, "mode", "");
  const std::string filter = word(extension, "filter", "NONE");
  const bool attributes = mode == "ATTRIBUTES";
  const bool indices = mode == "TRIANGLES" || mode == "INDICES";
  if (!attributes && !indices)
    gltf.fail(place, "is compressed in the unknown mode " + in_quotes(mode),
              ErrorKind::unsupported);
  const bool fits =
      attributes ? stride >= 4 && stride <= 256 && stride % 4 == 0 : stride == 2 || stride == 4;
  if (!fits || (mode == "TRIANGLES" && count % 3 != 0))
    gltf.fail(place, "'byteStride' or 'count' is none of its compression; export the file again");
  // Two bits tell of 16 equal bytes, the codec's most.
  constexpr std::size_t kMostRatio = 64;
  if (count > kMostRatio * bytes.size() / stride)
    gltf.fail(place, "promises " + std::to_string(count) + " elements of " +
                         std::to_string(bytes.size()) + " compressed bytes; it is damaged");

  std::string out(count * stride, '\0');
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int status = -1;
  if (attributes)
    status = meshopt_decodeVertexBuffer(out.data(), count, stride, data, bytes.size());
  else if (mode == "TRIANGLES")
    status = meshopt_decodeIndexBuffer(out.data(), count, stride, data, bytes.size());
  else
    status = meshopt_decodeIndexSequence(out.data(), count, stride, data, bytes.size());
  if (status != 0)
    gltf.fail(place, "cannot be decompressed (meshopt); it is damaged or of a newer codec");

  if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8))
    meshopt_decodeFilterOct(out.data(), count, stride);
  else if (filter == "QUATERNION" && stride == 8)
    meshopt_decodeFilterQuat(out.data(), count, stride);
  else if (filter == "EXPONENTIAL" && stride % 4 == 0)
    meshopt_decodeFilterExp(out.data(), count, stride);
  else if (filter != "NONE")
    gltf.fail(place, "is filtered by " + in_quotes(filter) + ", which is not handled",
              ErrorKind::unsupported);
  return out;
}

#else

bool meshopt_is_built_in() {
  return false;
}

std::string decode_meshopt(const GltfJson& gltf, const Json&, std::string_view,
                           const std::string& place) {
  fail_without_meshopt(gltf, place);
}

#endif

}  // namespace mimicry
