// SPDX-License-Identifier: MIT
// meshrepair-blocks plan | run | join: a mesh repaired block by block, on many machines.
#include <array>
#include <string_view>

#include <base/error.h>

#include "blocks/verbs.h"
#include "options/choice_option.h"
#include "program/program.h"

namespace meshrepair {
namespace {

using Act = int (*)(int, const char* const*);
constexpr std::array<Choice<Act>, 3> kVerbs = {
    {{"plan", plan_blocks}, {"run", run_block}, {"join", join_blocks}}};

// Says what there is.
int overview(int argc, const char* const* argv) {
  Program program("meshrepair-blocks",
                  "Repairs a mesh in blocks, on many machines. See VERB --help.",
                  "  meshrepair-blocks plan city.stl city.blocks\n"
                  "  meshrepair-blocks run city.blocks --block 1\n"
                  "  meshrepair-blocks join city.blocks repaired.ply\n");
  add_choice(
      program.command_line(), "VERB", kVerbs,
      [](Act) { throw UsageError("VERB: must precede all options"); },
      "What to do:\n"
      "  plan  divide a mesh into blocks\n"
      "  run   repair one of them\n"
      "  join  make one mesh of all")
      ->required();
  return program.run(argc, argv, [](Run&) { return ExitCode::done; });
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) {
  using namespace meshrepair;
  const std::string_view word = argc > 1 ? argv[1] : "";
  for (const auto& [name, act] : kVerbs) {
    if (name == word) return act(argc - 1, argv + 1);
  }
  return overview(argc, argv);
}
