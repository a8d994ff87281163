// SPDX-License-Identifier: MIT
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <gmock/gmock.h>
#include <jpeglib.h>
#include <png.h>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <picture/decode_image.h>
#include <picture/png_io.h>

#include "share_of_cases.h"

namespace meshrepair {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

Pixels gradient(std::uint32_t width, std::uint32_t height, bool opaque = true) {
  Pixels pixels;
  pixels.size = {width, height};
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const auto byte = [](std::uint32_t value) { return static_cast<std::uint8_t>(value); };
      pixels.values.push_back(
          {byte(8 * x), byte(8 * y), byte(4 * x + 2 * y), byte(opaque ? 255 : 16 * x)});
    }
  }
  return pixels;
}

// A PNG in another of its forms.
std::string png_of(std::uint32_t format, const void* values, std::uint32_t width,
                   std::uint32_t height, const void* colours = nullptr, unsigned count = 0) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = format;
  image.colormap_entries = count;
  image.flags = PNG_IMAGE_FLAG_16BIT_sRGB;
  std::string bytes(1 << 16, '\0');
  png_alloc_size_t size = bytes.size();
  EXPECT_NE(png_image_write_to_memory(&image, bytes.data(), &size, 0, values, 0, colours), 0)
      << image.message;
  bytes.resize(size);
  return bytes;
}

std::string jpeg_of(const Pixels& pixels, bool progressive = false,
                    J_COLOR_SPACE space = JCS_EXT_RGBA) {
  jpeg_compress_struct info;
  jpeg_error_mgr errors;
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &bytes, &size);
  info.image_width = pixels.size.width;
  info.image_height = pixels.size.height;
  info.input_components = 4;
  info.in_color_space = space;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 95, TRUE);
  if (progressive) jpeg_simple_progression(&info);
  jpeg_start_compress(&info, TRUE);
  for (std::size_t y = 0; y < pixels.size.height; ++y) {
    auto* row = const_cast<JSAMPROW>(pixels.at(0, y).data());
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  std::string result(reinterpret_cast<const char*>(bytes), size);
  jpeg_destroy_compress(&info);
  std::free(bytes);
  return result;
}

void expect_near(const Pixels& a, const Pixels& b, int most) {
  ASSERT_EQ(a.size, b.size);
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(a.values[i][k], b.values[i][k], most) << i;
  }
}

// Any bytes make a picture or an InputError.
void expect_no_crash(const std::string& bytes) {
  try {
    const Pixels pixels = decode_image(bytes, 1 << 20);
    EXPECT_EQ(pixels.values.size(), pixels.size.pixels());
  } catch (const InputError&) {
  }
}

void put_big_endian(std::string& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t k = 0; k < 4; ++k) {
    bytes[at + k] = static_cast<char>(value >> (24 - 8 * k));
  }
}

// With another size in its header, and the check sum of that.
std::string png_of_size(std::uint32_t width, std::uint32_t height) {
  std::string bytes = format_png(gradient(4, 4));
  put_big_endian(bytes, 16, width);
  put_big_endian(bytes, 20, height);
  std::uint32_t sum = 0xFFFFFFFF;
  for (std::size_t i = 12; i < 29; ++i) {
    sum ^= static_cast<unsigned char>(bytes[i]);
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ ((sum & 1) != 0 ? 0xEDB88320 : 0);
  }
  put_big_endian(bytes, 29, ~sum);
  return bytes;
}

TEST(FormatPng, IsReadBackBitForBit) {
  for (const bool opaque : {true, false}) {
    for (const auto& [width, height] : {std::pair{1U, 1U}, {1U, 9U}, {9U, 1U}, {33U, 20U}}) {
      const Pixels pixels = gradient(width, height, opaque);
      EXPECT_EQ(decode_image(format_png(pixels)), pixels);
    }
  }
}

TEST(DecodeImage, ReadsAllFormsOfPng) {
  const std::vector<std::uint8_t> grey = {0, 100, 200, 255};
  EXPECT_EQ(decode_image(png_of(PNG_FORMAT_GRAY, grey.data(), 2, 2)).at(1, 0),
            (Rgba{100, 100, 100, 255}));
  const std::vector<std::uint8_t> with_alpha = {50, 0, 60, 128};
  EXPECT_EQ(decode_image(png_of(PNG_FORMAT_GA, with_alpha.data(), 2, 1)).at(1, 0),
            (Rgba{60, 60, 60, 128}));
  const std::vector<std::uint8_t> colours = {1, 2, 3, 4, 5, 6}, indices = {0, 1, 1, 0};
  EXPECT_EQ(decode_image(png_of(PNG_FORMAT_RGB_COLORMAP, indices.data(), 2, 2, colours.data(), 2))
                .at(1, 0),
            (Rgba{4, 5, 6, 255}));
  const std::vector<std::uint16_t> deep = {0, 65535, 32768, 1000, 65535, 0};
  const Pixels pixels = decode_image(png_of(PNG_FORMAT_LINEAR_RGB, deep.data(), 2, 1));
  EXPECT_EQ(pixels.at(0, 0)[1], 255);
}

TEST(DecodeImage, ReadsJpeg) {
  const Pixels pixels = gradient(31, 17);
  expect_near(decode_image(jpeg_of(pixels)), pixels, 40);
  expect_near(decode_image(jpeg_of(pixels, true)), decode_image(jpeg_of(pixels)), 0);
  EXPECT_EQ(decode_image(jpeg_of(pixels)).at(3, 3)[3], 255);
}

TEST(DecodeImage, RefusesColoursOfInk) {
  EXPECT_THAT([] { (void)decode_image(jpeg_of(gradient(8, 8), false, JCS_CMYK)); },
              ThrowsMessage<InputError>(HasSubstr("is not a readable JPEG")));
}

TEST(DecodeImage, RefusesWhatIsNeither) {
  for (const std::string& bytes :
       {std::string(), std::string("GIF89a"), std::string("\xff\xd8"), std::string("\x89PNG")}) {
    EXPECT_THAT([&] { (void)decode_image(bytes); },
                ThrowsMessage<InputError>("is neither PNG nor JPEG"));
  }
}

TEST(DecodeImage, TakesNoMemoryForWhatIsTooLarge) {
  for (const PictureSize size :
       {PictureSize{16385, 1}, {1, 16385}, {16384, 16384}, {900000, 900000}}) {
    const std::string png = png_of_size(size.width, size.height);
    EXPECT_THAT([&] { (void)decode_image(png); },
                ThrowsMessage<InputError>(HasSubstr("is too large")));
  }
  EXPECT_THROW((void)decode_image(png_of_size(0, 5)), InputError);
  EXPECT_THROW((void)decode_image(png_of_size(0x7fffffff, 0x7fffffff)), InputError);
  std::string jpeg = jpeg_of(gradient(8, 8));
  const std::size_t frame = jpeg.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  for (std::size_t k = 5; k < 9; ++k) jpeg[frame + k] = '\x7f';
  EXPECT_THAT([&] { (void)decode_image(jpeg); },
              ThrowsMessage<InputError>("is too large: 32639 x 32639 pixels"));
  EXPECT_THAT([] { (void)decode_image(format_png(gradient(8, 8)), 63); },
              ThrowsMessage<InputError>("is too large: 8 x 8 pixels"));
}

TEST(DecodeImage, RefusesAJpegOfVeryManyScans) {
  const std::string jpeg = jpeg_of(gradient(8, 8), true);
  const std::size_t scan = jpeg.rfind("\xff\xda");
  ASSERT_NE(scan, std::string::npos);
  const std::string last = jpeg.substr(scan, jpeg.size() - 2 - scan);
  std::string bomb = jpeg.substr(0, jpeg.size() - 2);
  for (int i = 0; i < 5000; ++i) bomb += last;
  bomb += jpeg.substr(jpeg.size() - 2);
  EXPECT_THAT([&] { (void)decode_image(bomb); },
              ThrowsMessage<InputError>(HasSubstr("too many scans")));
}

TEST(DecodeImage, AnyEndIsAnErrorOrAPicture) {
  for (const std::string& whole : {format_png(gradient(12, 9, false)), jpeg_of(gradient(12, 9)),
                                   jpeg_of(gradient(12, 9), true)}) {
    for (std::size_t size = 0; size < whole.size(); ++size) expect_no_crash(whole.substr(0, size));
  }
  EXPECT_THAT(
      [] {
        const std::string png = format_png(gradient(12, 9));
        (void)decode_image(png.substr(0, png.size() / 2));
      },
      ThrowsMessage<InputError>(StartsWith("is not a readable PNG: ")));
}

TEST(DecodeImage, AnyChangedBytesAreAnErrorOrAPicture) {
  std::mt19937_64 random(1);
  for (const std::string& whole : {format_png(gradient(12, 9, false)), jpeg_of(gradient(12, 9)),
                                   jpeg_of(gradient(12, 9), true)}) {
    for (int i = 0; i < share_of_cases(4000); ++i) {
      std::string bytes = whole;
      for (std::uint64_t n = random() % 4 + 1; n > 0; --n) {
        bytes[random() % bytes.size()] = static_cast<char>(random());
      }
      expect_no_crash(bytes);
    }
  }
}

}  // namespace
}  // namespace meshrepair
