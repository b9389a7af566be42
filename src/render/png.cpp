#include "render/png.h"

#include <png.h>

#include <mimicry/base/error.h>

namespace mimicry::render {

std::string write_png(const Image& image) {
  if (image.width <= 0 || image.height <= 0 ||
      image.rgb.size() !=
          3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
    throw Error(ErrorKind::invalid_input,
                "PNG: the image has no pixels or not three bytes for each; render it first");
  }
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) == 0) {
    const std::string message = png.message;
    png_image_free(&png);
    throw Error(ErrorKind::io, "PNG: " + message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace mimicry::render
