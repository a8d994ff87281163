// SPDX-License-Identifier: MIT
#include "describe/command_facts.h"

#include <array>
#include <gmock/gmock.h>

#include <gtest/gtest.h>

#include "describe/man_page.h"
#include "options/choice_option.h"
#include "options/file_kinds.h"

namespace meshrepair {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::array<Choice<int>, 2> kWays = {{{"fast", 1}, {"well", 2}}};

CommandFacts facts() {
  CommandLine app("Does it.", "doer");
  std::string text;
  bool flag = false;
  app.add_option("IN", text, "Mesh to read")->check(names_file(".stl, .obj"))->required();
  add_choice(
      app, "--way", kWays, [](int) {},
      "How it is done:\n"
      "  fast  at once, and\n"
      "        not well\n"
      "  well  .slowly\n"
      "Not both.")
      ->default_str("fast")
      ->group("Work");
  app.add_option("--far", text, "As far as this. Or not")
      ->type_name("auto|none|X|X%")
      ->group("Work");
  app.add_flag("-q,--quiet", flag, "Say nothing")->group("Work");
  app.add_flag("--secret", flag, "For us")->group("");
  app.set_footer("Examples:\n  doer in.stl\n");
  return facts_of(app);
}

TEST(CommandFacts, ArgumentsComeFirstAndWhatHelpHidesIsNotThere) {
  std::vector<std::string> names;
  for (const OptionFacts& option : facts().options) names.push_back(option.name());
  EXPECT_THAT(names, ElementsAre("IN", "--way", "--far", "--quiet"));
  EXPECT_THAT(facts().examples, ElementsAre("doer in.stl"));
}

TEST(CommandFacts, AFileHasExtensions) {
  const OptionFacts in = facts().options[0];
  EXPECT_TRUE(in.is_argument && in.is_required && in.is_file);
  EXPECT_THAT(in.extensions, ElementsAre("stl", "obj"));
}

TEST(CommandFacts, ChoicesHaveMeanings) {
  const OptionFacts way = facts().options[1];
  EXPECT_EQ(way.type, "NAME");
  EXPECT_THAT(way.choices, ElementsAre("fast", "well"));
  EXPECT_EQ(way.meaning_of("fast"), "at once, and not well");
  EXPECT_EQ(way.headline(), "How it is done");
  EXPECT_EQ(way.description.back().text, "Not both.");
  EXPECT_EQ(way.default_value, "fast");
}

TEST(CommandFacts, WordsOfATypeAreChoicesIfTheyAreMeantAsTheyAre) {
  const OptionFacts far = facts().options[2];
  EXPECT_THAT(far.choices, ElementsAre("auto", "none"));
  EXPECT_EQ(far.headline(), "As far as this");
}

TEST(CommandFacts, AFlagHasNoValue) {
  const OptionFacts quiet = facts().options[3];
  EXPECT_THAT(quiet.names, ElementsAre("-q", "--quiet"));
  EXPECT_EQ(quiet.type, "");
  EXPECT_THAT(quiet.choices, IsEmpty());
}

TEST(ManPage, WhatMeansSomethingToManIsEscaped) {
  const std::string page = man_page(facts());
  EXPECT_THAT(page, HasSubstr("\n.TP\n\\fB\\-q\\fR, \\fB\\-\\-quiet\\fR\nSay nothing\n"));
  EXPECT_THAT(page, HasSubstr("\n\\fBwell\\fR\n\\&.slowly\n"));
  EXPECT_THAT(page, HasSubstr("\n\\fBdoer\\fR [\\fIOPTIONS\\fR] \\fIIN\\fR\n"));
}

}  // namespace
}  // namespace meshrepair
