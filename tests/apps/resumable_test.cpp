// SPDX-License-Identifier: MIT
// Which options are part of what a run that is resumed has to have in common with the first one.
#include "resume/resumable.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "program/common_options.h"
#include "steps/repair_command.h"

namespace meshrepair {
namespace {

class OptionsOfMeshrepair : public ::testing::Test {
 protected:
  OptionsOfMeshrepair() {
    app_.add_option("IN", command_.steps.input, "");
    app_.add_option("OUT", command_.steps.output, "");
    add_repair_command(app_, command_);
    add_resume_option(app_, folder_);
    add_common_options(app_, common_);
  }

  RepairCommand command_;
  std::string folder_;
  CommonOptions common_;
  CommandLine app_ = CommandLine("", "meshrepair");
};

// By two ways: the names that are known to change nothing, and what the help says they are about.
// One that is new, or misfiled, is to be looked at.
TEST_F(OptionsOfMeshrepair, ChangeResultsUnlessTheyAreAboutRunningAndTelling) {
  const std::set<std::string> telling = {"Running", "Reporting", "Picture", "Page"};
  std::size_t changing = 0, others = 0;
  for (const CommandOption* option : app_.options()) {
    const std::string name = option->name();
    const bool is_other =
        telling.contains(option->heading()) || name == "IN" || name == "--explain";
    EXPECT_EQ(changes_results(*option), !is_other) << name;
    ++(is_other ? others : changing);
  }
  EXPECT_GE(changing, 35u);
  EXPECT_GE(others, 20u);
}

// The format is part of them, packed or not.
TEST_F(OptionsOfMeshrepair, AreThoseOfTheFormatThatIsWritten) {
  const auto options_for = [&](const std::string& output) {
    (void)app_.parse(std::vector<std::string>{"in.off", output});
    return options_of_results(app_, {});
  };
  EXPECT_EQ(options_for("a.stl"), options_for("b.stl"));
  EXPECT_EQ(options_for("a.stl"), options_for("a.stl.gz"));
  EXPECT_NE(options_for("a.stl"), options_for("a.obj"));
  EXPECT_NE(options_for("a.stl.gz"), options_for("a.obj.gz"));
}

TEST_F(OptionsOfMeshrepair, OneThatIsNotKnownChangesResultsWhereverItIsFiled) {
  bool is_fresh = false;
  CommandOption* const fresh = app_.add_flag("--fresh", is_fresh, "")->group("Running");
  EXPECT_TRUE(changes_results(*fresh));
}

}  // namespace
}  // namespace meshrepair
