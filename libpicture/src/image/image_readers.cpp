// SPDX-License-Identifier: MIT
#include "image_readers.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it before itself
#include <jpeglib.h>
#include <limits>
#include <png.h>
#include <string>

#include <base/error.h>

namespace meshrepair {
namespace {

// What refines a picture again and again takes time for each round, however few bytes it has.
constexpr int kMostScans = 100;

// Errors jump back out of libjpeg: nothing with a destructor may live in the functions that they
// jump over.
struct Decoder {
  jpeg_decompress_struct info;
  jpeg_error_mgr errors;
  jpeg_progress_mgr progress;
  std::jmp_buf back;
  std::array<char, JMSG_LENGTH_MAX> message;
};

[[noreturn]] void jump_back(Decoder& decoder) { std::longjmp(decoder.back, 1); }

[[noreturn]] void on_error(j_common_ptr info) {
  Decoder& decoder = *static_cast<Decoder*>(info->client_data);
  info->err->format_message(info, decoder.message.data());
  jump_back(decoder);
}

void on_message(j_common_ptr /*info*/, int /*level*/) {}

void on_progress(j_common_ptr info) {
  Decoder& decoder = *static_cast<Decoder*>(info->client_data);
  if (decoder.info.input_scan_number <= kMostScans) return;
  std::snprintf(decoder.message.data(), decoder.message.size(), "too many scans");
  jump_back(decoder);
}

bool begin(Decoder& decoder, std::string_view bytes) {
  decoder.info.err = jpeg_std_error(&decoder.errors);
  decoder.errors.error_exit = on_error;
  decoder.errors.emit_message = on_message;
  decoder.info.client_data = &decoder;
  if (setjmp(decoder.back) != 0) return false;
  jpeg_create_decompress(&decoder.info);
  decoder.progress.progress_monitor = on_progress;
  decoder.info.progress = &decoder.progress;
  // Of more than a number of the library can count, the end is missing.
  constexpr std::size_t kMost = std::numeric_limits<unsigned long>::max();
  jpeg_mem_src(&decoder.info, reinterpret_cast<const unsigned char*>(bytes.data()),
               static_cast<unsigned long>(std::min(bytes.size(), kMost)));
  jpeg_read_header(&decoder.info, TRUE);
  return true;
}

// Slow and exact, so that all processors get the same.
bool read_rows(Decoder& decoder, Rgba* row) {
  if (setjmp(decoder.back) != 0) return false;
  decoder.info.out_color_space = JCS_EXT_RGBA;
  decoder.info.dct_method = JDCT_ISLOW;
  jpeg_start_decompress(&decoder.info);
  while (decoder.info.output_scanline < decoder.info.output_height) {
    JSAMPROW line =
        row[std::size_t{decoder.info.output_scanline} * decoder.info.output_width].data();
    jpeg_read_scanlines(&decoder.info, &line, 1);
  }
  return true;
}

struct JpegImage {
  JpegImage() = default;
  JpegImage(const JpegImage&) = delete;
  JpegImage& operator=(const JpegImage&) = delete;
  ~JpegImage() { jpeg_destroy_decompress(&decoder.info); }

  [[noreturn]] void fail() const {
    throw InputError(std::string("is not a readable JPEG: ") + decoder.message.data());
  }

  Decoder decoder{};
};

}  // namespace

bool begins_with_jpeg(std::string_view bytes) {
  return bytes.substr(0, 3) == std::string_view("\xff\xd8\xff");
}

Pixels read_jpeg(std::string_view bytes, std::size_t most_pixels) {
  JpegImage reader;
  jpeg_decompress_struct& info = reader.decoder.info;
  if (!begin(reader.decoder, bytes)) reader.fail();
  Pixels pixels = filled(checked_image_size(info.image_width, info.image_height, most_pixels), {});
  if (!read_rows(reader.decoder, pixels.values.data())) reader.fail();
  return pixels;
}

namespace {

// What libpng holds while it reads.
struct PngImage {
  PngImage() { image.version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(&image); }

  [[noreturn]] void fail() const {
    throw InputError(std::string("is not a readable PNG: ") + image.message);
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
