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

RgbaImage read_png(std::string_view bytes, std::string_view name, int most) {
  const auto fail = [&](const std::string& why) {
    throw Error(ErrorKind::invalid_input, std::string(name) + ": " + why);
  };
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const auto fail_to_read = [&] {
    const std::string message = png.message;
    png_image_free(&png);
    fail("cannot be read as PNG (" + message + "); save it anew");
  };
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) fail_to_read();
  if (png.width > static_cast<png_uint_32>(most) || png.height > static_cast<png_uint_32>(most)) {
    const std::string size = std::to_string(png.width) + " x " + std::to_string(png.height);
    png_image_free(&png);
    fail("has " + size + " pixels; give at most " + std::to_string(most) + " a side");
  }
  png.format = PNG_FORMAT_RGBA;
  RgbaImage image;
  image.width = static_cast<int>(png.width);
  image.height = static_cast<int>(png.height);
  image.pixels.resize(static_cast<std::size_t>(png.width) * png.height);
  if (png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr) == 0) fail_to_read();
  return image;
}

}  // namespace mimicry::render
