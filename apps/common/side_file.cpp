#include "common/side_file.h"

#include <filesystem>

#include <base/error.h>

#include "common/repair_steps.h"

namespace meshrepair {

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

void check_side_file(const SideFile& file, const std::vector<std::string>& others, Run& run) {
  if (!run.options.report.empty() && is_same_file(run.options.report, file.path)) {
    run.report.withhold();
    throw UsageError("--report: " + file.path + " is the " + file.what + ", too");
  }
  for (const std::string& other : others) {
    if (other.empty() || !is_same_file(file.path, other)) continue;
    throw UsageError(file.option + ": " + file.path + " is another file of this command, too");
  }
  check_folder(file.path);
}

}  // namespace meshrepair
