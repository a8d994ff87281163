// SPDX-License-Identifier: MIT

#include "summary/summary.h"

#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "report/findings.h"
#include "report/words.h"

namespace meshrepair {
namespace {

Findings findings_with_every_defect() {
  Findings findings("in.stl", "out.stl");
  findings.mesh_read = ReadReport();
  findings.mesh_read->bad_faces = findings.mesh_read->missing_faces = 1;
  RepairReport& repair = findings.repair;
  repair.clean.duplicates = repair.clean.dropped_degenerate = repair.clean.dropped_not_finite = 2;
  repair.clean.dropped_below_grid = 2;
  repair.input.open_edges = repair.input.nonmanifold_edges = 3;
  repair.input.inconsistent_edges = repair.input.nonmanifold_vertices = 4;
  repair.orient.turned_triangles = 5;
  repair.inside.contradictions = 6;
  repair.inside.solid_cells = 7;
  return findings;
}

TEST(Summary, NumbersAreGrouped) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(1234567), "1,234,567");
  EXPECT_EQ(number_of(1, "part"), "1 part");
  EXPECT_EQ(number_of(1200, "part"), "1,200 parts");
}

TEST(Summary, HasADozenAlignedLinesAtMost) {
  std::istringstream lines(summary_of(findings_with_every_defect(), 1));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_EQ(line[9], ' ') << line;
    EXPECT_NE(line[10], ' ') << line;
    EXPECT_LE(line.size(), 100) << line;
  }
  EXPECT_LE(count, 12);
}

TEST(Summary, CountsTheFallbacksOfFloatingPredicatesInLinesOfTheSameWidth) {
  Findings findings = findings_with_every_defect();
  EXPECT_EQ(summary_of(findings, 1).find("floating point"), std::string::npos);
  RepairReport& repair = findings.repair;
  repair.predicates = Predicates::floating;
  repair.epsilon = 5e-10;
  repair.clip = {12345678, 12345678, 123456, 1234567, 123456, 1234567};
  repair.cover.guessed_facets = repair.extract.polygons_apart = 123456;
  const std::string summary = summary_of(findings, 1);
  EXPECT_NE(summary.find("\nsides     in floating point, eps 5e-10, over 12,345,678 cuts\n"),
            std::string::npos);
  EXPECT_NE(summary.find("123,456 cuts with several regions, 1,234,567 cuts forced"),
            std::string::npos);
  EXPECT_NE(summary.find("123,456 facets clipped as stars"), std::string::npos);
  std::istringstream lines(summary);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100) << line;
}

TEST(Summary, SaysWhatDoesNotHold) {
  const std::string summary = summary_of(findings_with_every_defect(), 1);
  EXPECT_NE(summary.find("NOT CLOSED"), std::string::npos);  // an output without triangles
}

TEST(Summary, StreamsHaveNames) {
  const Findings findings("-", "-");
  EXPECT_EQ(findings.input_name(), "standard input");
  EXPECT_EQ(findings.output_name(), "standard output");
}

}  // namespace
}  // namespace meshrepair
