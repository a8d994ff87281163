// SPDX-License-Identifier: MIT
#include "steps/requirements.h"

#include <gmock/gmock.h>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>

namespace meshrepair {
namespace {

using ::testing::HasSubstr;

// A cube of volume 8 that became two bodies of volume 10.
Findings some_findings() {
  Findings findings("in.stl", "out.stl");
  RepairReport& repair = findings.repair;
  repair.spared_cells = true;
  repair.stages = {{"check", 0, 0, 0}, {"extract", 0, 0, 0}};
  repair.clean.triangles_in = 10;
  repair.input.parts = 1;
  repair.input_area = 24;
  repair.input_volume = -8;  // inside out
  repair.output.parts = 2;
  repair.output.triangles = 15;
  repair.output_area = 50;
  repair.output_volume = 10;
  repair.closing_area = 5;
  repair.lost_area = 6;
  repair.holes.closed = 3;
  repair.sew.farthest_move = 0.25;
  Fidelity fidelity;
  fidelity.kept_to_output.emplace().largest = 0.125;
  fidelity.output_to_input.largest = 2;
  fidelity.diagonal = 10;
  findings.fidelity = fidelity;
  return findings;
}

// Whether it is met.
bool is_met(const std::string& text, Findings findings = some_findings()) {
  judge_requirements({parse_requirement(text)}, findings);
  EXPECT_EQ(findings.required.size(), 1U);
  return findings.not_met.empty();
}

std::string complaint(const std::string& text) {
  try {
    (void)parse_requirement(text);
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

TEST(Requirements, AreMetAtTheirBoundsAndNotBeyond) {
  const std::vector<std::pair<std::string, std::string>> met_and_not = {
      {"parts=2", "parts=1"},
      {"parts<=2", "parts<=1"},
      {"parts>=2", "parts>=3"},
      {"parts=100%", "parts=99%"},
      {"parts<=2x", "parts<=1.9x"},
      {"triangles<=1.5x", "triangles<=1.49x"},
      {"triangles>=1.5x", "triangles>=1.51x"},
      {"volume=25%", "volume=24.9%"},
      {"volume<=10", "volume<=9.99"},
      {"area<=50", "area>=50.1"},
      {"lost-area<=25%", "lost-area<=24%"},
      {"lost-area<=6", "lost-area<=5"},
      {"made-up<=10%", "made-up<=9.9%"},
      {"holes<=3", "holes<=2"},
      {"warnings=0", "warnings>=1"},
      {"W-AREA-LOST=0", "W-AREA-LOST=1"},
      {"distance<=2", "distance<=1.9"},
      {"distance<=20%", "distance<=19%"},
      {"result.parts=2", "result.parts=3"},
      {"defects.volume>=-8", "defects.volume>=-7"},
  };
  for (const auto& [met, not_met] : met_and_not) {
    EXPECT_TRUE(is_met(met)) << met;
    EXPECT_FALSE(is_met(not_met)) << not_met;
  }
  EXPECT_FALSE(is_met("parts=same"));
  EXPECT_FALSE(is_met("volume=same"));
}

TEST(Requirements, MovedIsTheFarthestOfAllMoves) {
  Findings findings = some_findings();
  findings.repair.stages.push_back({"sew", 0, 0, 0});
  EXPECT_TRUE(is_met("moved<=0.25", findings));
  EXPECT_FALSE(is_met("moved<=0.24", findings));
  EXPECT_TRUE(is_met("moved<=2.5%", findings));
  findings.fidelity->kept_to_output.reset();
  EXPECT_FALSE(is_met("moved<=100", findings));  // it is not known
}

TEST(Requirements, OnWhatIsNotKnownAreNotMet) {
  Findings findings("in.stl", "out.stl");
  judge_requirements({parse_requirement("volume<=1e9"), parse_requirement("no.such=1"),
                      parse_requirement("volume=1%")},
                     findings);
  ASSERT_EQ(findings.not_met.size(), 3U);
  EXPECT_THAT(findings.not_met[1], HasSubstr("no.such=1 is not met: unknown"));
}

TEST(Requirements, NonsenseIsSaidInOneLine) {
  for (const std::string text :
       {"", "parts", "prats=1", "parts=", "parts=many", "parts<2", "parts<=same", "holes=1%",
        "W-AREA-LOST=1x", "volume>=1%", "made-up=same", "volume=-1%", "volume=nan", "volume=inf",
        "result.parts=1%", "=1", "W-NO-SUCH=0", "moved<=2x"}) {
    const std::string said = complaint(text);
    EXPECT_THAT(said, HasSubstr("--require: ")) << text;
    EXPECT_EQ(said.find('\n'), std::string::npos) << text;
  }
  EXPECT_EQ(complaint("  parts  <=  1.5x  "), "");
}

TEST(Requirements, AskForTheDistanceWhereTheyNeedIt) {
  const auto asks = [](const std::string& text) {
    return asks_for_distance({parse_requirement(text)});
  };
  EXPECT_TRUE(asks("moved<=1"));
  EXPECT_TRUE(asks("distance.kept_triangles>=1"));
  EXPECT_FALSE(asks("volume=1%"));
}

}  // namespace
}  // namespace meshrepair
