// SPDX-License-Identifier: MIT
#include "process/progress_bar.h"

#include <gmock/gmock.h>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include <base/error.h>

namespace meshrepair {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string text_of(std::FILE* file) {
  std::rewind(file);
  std::string text;
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text += static_cast<char>(c);
  return text;
}

TEST(ProgressLine, ShowsStageShareAndSeconds) {
  EXPECT_EQ(progress_line("cells", 0.5, 3.25, 44), "cells         50% [=========         ] 3.2 s");
}

TEST(ProgressLine, FitsTheTerminal) {
  for (int columns = 0; columns < 200; ++columns) {
    EXPECT_LE(progress_line("a stage of a long name", 0.3, 1234.5, columns).size(),
              static_cast<std::size_t>(columns));
  }
}

TEST(ProgressLine, ShareIsClamped) {
  EXPECT_THAT(progress_line("x", -1, 0, 80), HasSubstr("  0% [ "));
  EXPECT_THAT(progress_line("x", 2, 0, 80), HasSubstr("100% [="));
  EXPECT_THAT(progress_line("x", std::numeric_limits<double>::quiet_NaN(), 0, 80),
              HasSubstr("  0%"));
}

TEST(ProgressBar, DrawsAndClears) {
  const File file(std::tmpfile());
  ASSERT_NE(file, nullptr);
  {
    ProgressBar bar({.draw = true, .time_limit = 0, .terminal = file.get(), .delay = 0});
    bar.stage("tree");
    bar.advance(0.5);
  }
  EXPECT_THAT(text_of(file.get()), HasSubstr("tree"));
  EXPECT_THAT(text_of(file.get()), EndsWith("\r\x1b[K"));
}

TEST(ProgressBar, SaysNothingUnlessAsked) {
  const File file(std::tmpfile());
  ASSERT_NE(file, nullptr);
  ProgressBar bar({.draw = false, .time_limit = 0, .terminal = file.get(), .delay = 0});
  bar.stage("tree");
  bar.advance(0.5);
  bar.finish();
  EXPECT_EQ(text_of(file.get()), "");
}

TEST(ProgressBar, AddsUpStagesByName) {
  ProgressBar bar;
  bar.stage("read");
  bar.stage("tree");
  bar.stage("read");
  bar.finish();
  bar.finish();
  ASSERT_EQ(bar.stages().size(), 2U);
  EXPECT_EQ(bar.stages()[0].name, "read");
  EXPECT_EQ(bar.stages()[1].name, "tree");
}

TEST(ProgressBar, TimeLimitIsAnError) {
  ProgressBar bar({.draw = false, .time_limit = 1e-9, .terminal = stderr, .delay = 0});
  bar.stage("tree");
  EXPECT_THROW(static_cast<void>(bar.cancelled()), LimitError);
}

}  // namespace
}  // namespace meshrepair
