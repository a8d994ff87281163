#include "image/png_reader.h"

#include <png.h>
#include <string>

#include <base/error.h>

#include "image/image_size.h"

namespace meshrepair {
namespace {

// What libpng holds while it reads.
struct PngImage {
  PngImage() { image.version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(&image); }

  [[noreturn]] void fail() const {
    throw InputError(std::string("is no PNG that can be read: ") + image.message);
  }

  png_image image{};
};

}  // namespace

bool begins_with_png(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n"sv;
  return bytes.substr(0, kSignature.size()) == kSignature;
}

Pixels read_png(std::string_view bytes, std::size_t most_pixels) {
  PngImage reader;
  png_image& image = reader.image;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) reader.fail();
  Pixels pixels = filled(checked_image_size(image.width, image.height, most_pixels), {});
  image.format = PNG_FORMAT_RGBA;
  image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // as programs write them that do not say
  if (png_image_finish_read(&image, nullptr, pixels.values.data(), 0, nullptr) == 0) reader.fail();
  return pixels;
}

}  // namespace meshrepair
