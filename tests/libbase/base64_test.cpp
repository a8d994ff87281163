// SPDX-License-Identifier: MIT
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include <base/base64.h>

namespace meshrepair {
namespace {

TEST(Base64, EncodesAsRfc4648Says) {
  EXPECT_EQ(encode_base64(""), "");
  EXPECT_EQ(encode_base64("f"), "Zg==");
  EXPECT_EQ(encode_base64("fo"), "Zm8=");
  EXPECT_EQ(encode_base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, AllBytesComeBack) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  EXPECT_EQ(decode_base64(encode_base64(bytes)), bytes);
}

TEST(Base64, RefusesOtherText) {
  EXPECT_EQ(decode_base64("Zm9v!mFy"), std::nullopt);
  EXPECT_EQ(decode_base64("Zm9vY"), std::nullopt);
}

}  // namespace
}  // namespace meshrepair
