// SPDX-License-Identifier: MIT
#include <algorithm>
#include <csetjmp>
#include <new>
#include <png.h>
#include <utility>
#include <vector>

#include <base/assert.h>
#include <base/error.h>
#include <picture/png_io.h>

namespace meshrepair {
namespace {

// Errors jump back out of libpng: nothing with a destructor may live in the functions that they
// jump over.
struct Encoder {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string bytes;
  bool out_of_memory = false;

  Encoder() = default;
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;
  ~Encoder() { png_destroy_write_struct(&png, &info); }
};

void on_png_warning(png_structp /*png*/, png_const_charp /*message*/) {}

[[noreturn]] void on_png_error(png_structp png, png_const_charp /*message*/) {
  png_longjmp(png, 1);
}

void append_bytes(png_structp png, png_bytep data, std::size_t size) {
  Encoder& encoder = *static_cast<Encoder*>(png_get_io_ptr(png));
  try {
    encoder.bytes.append(reinterpret_cast<const char*>(data), size);
  } catch (const std::bad_alloc&) {
    encoder.out_of_memory = true;
  }
  if (encoder.out_of_memory) png_longjmp(png, 1);
}

void flush_nothing(png_structp /*png*/) {}

bool encode(Encoder& encoder, PictureSize size, int colour_type, const png_bytep* rows) {
  encoder.png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, on_png_error, on_png_warning);
  if (encoder.png == nullptr) return false;
  encoder.info = png_create_info_struct(encoder.png);
  if (encoder.info == nullptr) return false;
  if (setjmp(png_jmpbuf(encoder.png)) != 0) return false;
  png_set_write_fn(encoder.png, &encoder, append_bytes, flush_nothing);
  png_set_compression_level(encoder.png, 6);
  png_set_filter(encoder.png, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
  png_set_IHDR(encoder.png, encoder.info, size.width, size.height, 8, colour_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(encoder.png, encoder.info);
  png_write_image(encoder.png, const_cast<png_bytepp>(rows));
  png_write_end(encoder.png, nullptr);
  return true;
}

}  // namespace

std::string format_png(const Pixels& pixels) {
  MESHREPAIR_ASSERT(pixels.size.pixels() > 0);
  const bool is_opaque = std::all_of(pixels.values.begin(), pixels.values.end(),
                                     [](const Rgba& value) { return value[3] == 255; });
  const std::size_t channels = is_opaque ? 3 : 4;
  std::vector<png_byte> values;
  values.reserve(channels * pixels.values.size());
  for (const Rgba& value : pixels.values) {
    values.insert(values.end(), value.begin(), value.begin() + channels);
  }
  std::vector<png_bytep> rows(pixels.size.height);
  for (std::size_t y = 0; y < rows.size(); ++y) {
    rows[y] = values.data() + y * pixels.size.width * channels;
  }
  Encoder encoder;
  const int colour_type = is_opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA;
  if (!encode(encoder, pixels.size, colour_type, rows.data())) throw std::bad_alloc();
  return std::move(encoder.bytes);
}

}  // namespace meshrepair
