// SPDX-License-Identifier: MIT
#include "report/json_report.h"

#include <gmock/gmock.h>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <base/error.h>

namespace meshrepair {
namespace {

using testing::ElementsAre;

using Parsed = nlohmann::ordered_json;

std::vector<std::string> keys_of(const Parsed& object) {
  std::vector<std::string> keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  return keys;
}

TEST(JsonReport, FrameIsCompleteAndInOrder) {
  JsonReport report("test", {"test", "in.stl"});
  report.set_section("repair", {{"cells", 5}});
  report.set_input({{"path", "in.stl"}});
  const Parsed json = Parsed::parse(report.text(ExitCode::done, std::nullopt, ProgressBar()));
  EXPECT_THAT(keys_of(json), ElementsAre("program", "version", "report_version", "command", "input",
                                         "output", "repair", "warnings", "stages", "seconds",
                                         "peak_memory_bytes", "exit_code", "error"));
  EXPECT_EQ(json["repair"]["cells"], 5);
  EXPECT_EQ(json["input"]["path"], "in.stl");
  EXPECT_TRUE(json["output"].is_null());
  EXPECT_TRUE(json["error"].is_null());
  EXPECT_GT(json["peak_memory_bytes"], 0);
}

TEST(JsonReport, StagesThatAreGivenReplaceThoseOfTheProgress) {
  JsonReport report("test", {"test"});
  const std::size_t peak = std::size_t{1} << 50;
  report.set_stages({{{"name", "tree"}, {"seconds", 1.5}, {"peak_bytes", peak}}});
  const Parsed json = Parsed::parse(report.text(ExitCode::done, std::nullopt, ProgressBar()));
  EXPECT_EQ(json["stages"].size(), 1);
  EXPECT_EQ(json["stages"][0]["name"], "tree");
  EXPECT_EQ(json["peak_memory_bytes"], peak);
}

TEST(JsonReport, FailureHasCodeAndMessage) {
  const JsonReport report("test", {"test"});
  const Failure failure = {ExitCode::no_solid, "in.stl: encloses nothing"};
  const Parsed json = Parsed::parse(report.text(failure.code, failure, ProgressBar()));
  EXPECT_EQ(json["exit_code"], 5);
  EXPECT_EQ(json["error"], "in.stl: encloses nothing");
}

TEST(JsonReport, ErrorsNeedNotBeThrown) {
  JsonReport report("test", {"test"});
  report.set_error("error: out.stl: written, but not closed");
  const Parsed json =
      Parsed::parse(report.text(ExitCode::not_certified, std::nullopt, ProgressBar()));
  EXPECT_EQ(json["exit_code"], 1);
  EXPECT_EQ(json["error"], "error: out.stl: written, but not closed");
}

TEST(JsonReport, FileNamesNeedNotBeUtf8) {
  JsonReport report("test", {"test", "\xff.stl"});
  const Parsed json = Parsed::parse(report.text(ExitCode::done, std::nullopt, ProgressBar()));
  EXPECT_EQ(json["command"][1], "\xEF\xBF\xBD.stl");
}

TEST(JsonReport, NumbersThatAreNotFiniteAreNull) {
  JsonReport report("test", {"test"});
  report.set_section("x", {{"volume", std::numeric_limits<double>::quiet_NaN()}});
  const Parsed json = Parsed::parse(report.text(ExitCode::done, std::nullopt, ProgressBar()));
  EXPECT_TRUE(json["x"]["volume"].is_null());
}

TEST(JsonReport, SectionsCannotReplaceTheFrame) {
  JsonReport report("test", {"test"});
  EXPECT_THROW(report.set_section("program", 1), InternalError);
  EXPECT_THROW(report.set_section("exit_code", 1), InternalError);
}

}  // namespace
}  // namespace meshrepair
