// Files that are asked for beside the output: a picture, an explanation, a page.
#pragma once

#include <string>
#include <vector>

#include "common/program.h"

namespace meshrepair {

// ".png", of "A.PNG" too; empty where there is none.
[[nodiscard]] std::string lower_extension(const std::string& path);

struct SideFile {
  std::string option;  // "--picture"
  std::string path;
  std::string what;  // "picture"
};

// What can be said of it before hours of work. `others` are the other files of the command, of
// which some may be empty. Throws UsageError where it is one of them, or the report, which it
// withholds then; OutputError where it cannot be written.
void check_side_file(const SideFile& file, const std::vector<std::string>& others, Run& run);

}  // namespace meshrepair
