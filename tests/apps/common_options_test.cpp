// SPDX-License-Identifier: MIT
#include "program/common_options.h"

#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>

namespace meshrepair {
namespace {

CommonOptions parse(std::vector<const char*> arguments) {
  CommandLine app("", "test");
  CommonOptions options;
  add_common_options(app, options);
  arguments.insert(arguments.begin(), "test");
  EXPECT_TRUE(parse_command_line(app, static_cast<int>(arguments.size()), arguments.data()));
  return options;
}

std::string report_of(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "test");
  return find_report_option(static_cast<int>(arguments.size()), arguments.data());
}

TEST(CommonOptions, NothingGivenGivesTheDefaults) {
  const CommonOptions options = parse({});
  EXPECT_EQ(options.report, "");
  EXPECT_EQ(options.threads, 0U);
  EXPECT_EQ(options.time_limit, 0);
  EXPECT_EQ(options.verbosity(), Verbosity::normal);
}

TEST(CommonOptions, AreParsed) {
  const CommonOptions options =
      parse({"--report", "-", "--threads", "3", "--time-limit", "2.5", "-v"});
  EXPECT_EQ(options.report, "-");
  EXPECT_EQ(options.threads, 3U);
  EXPECT_EQ(options.time_limit, 2.5);
  EXPECT_EQ(options.verbosity(), Verbosity::verbose);
  EXPECT_EQ(parse({"-q"}).verbosity(), Verbosity::quiet);
}

TEST(CommonOptions, NonsenseIsAUsageError) {
  for (const std::vector<const char*>& nonsense :
       std::vector<std::vector<const char*>>{{"--threads", "-1"},
                                             {"--threads", "1.5"},
                                             {"--time-limit", "-1"},
                                             {"--time-limit", "nan"},
                                             {"--time-limit", "soon"},
                                             {"--report"},
                                             {"extra"}}) {
    EXPECT_THROW(parse(nonsense), UsageError) << nonsense.front();
  }
}

TEST(FindReportOption, FindsBothSpellings) {
  EXPECT_EQ(report_of({"in", "--report", "r.json"}), "r.json");
  EXPECT_EQ(report_of({"--report=r.json", "in"}), "r.json");
  EXPECT_EQ(report_of({"--report", "-"}), "-");
}

TEST(FindReportOption, TakesNoOptionForAFile) {
  EXPECT_EQ(report_of({"--report", "--quiet"}), "");
  EXPECT_EQ(report_of({"--report"}), "");
  EXPECT_EQ(report_of({"--", "--report", "r.json"}), "");
  EXPECT_EQ(report_of({"--reports", "r.json"}), "");
}

TEST(FindReportOption, TakesNoFileThatAnotherArgumentNames) {
  EXPECT_EQ(report_of({"in", "out", "--report", "in"}), "");
  EXPECT_EQ(report_of({"in", "out", "--report=out"}), "");
  EXPECT_EQ(report_of({"-", "-", "--report", "-"}), "");
}

}  // namespace
}  // namespace meshrepair
