// SPDX-License-Identifier: MIT
// The warnings of a run: on stderr for people, with their codes, and kept for the report.
#pragma once

#include <string>
#include <vector>

#include <base/warning.h>

namespace meshrepair {

struct ToldWarning {
  std::string about;  // a file, a mesh of it, an option; empty: the run
  Warning warning;
};

// Takes what is told on the thread that made it, until its end. There is one at most.
class WarningLog {
 public:
  WarningLog();
  ~WarningLog();
  WarningLog(const WarningLog&) = delete;
  WarningLog& operator=(const WarningLog&) = delete;

  [[nodiscard]] const std::vector<ToldWarning>& told() const { return told_; }

 private:
  friend void warn(const std::string& about, const std::vector<Warning>& warnings);
  friend void show_held_warnings();

  std::vector<ToldWarning> told_;
  std::vector<std::string> held_;
};

// "in.stl: 97 % of the input area encloses nothing [W-AREA-LOST]".
[[nodiscard]] std::string text_of(const ToldWarning& told);

// Logs the first of them, and how many more there are. Those that change the object are held back
// until show_held_warnings(), so that they stand right above the summary.
void warn(const std::string& about, const std::vector<Warning>& warnings);
void warn(const std::string& about, Warning warning);

// Of this thread, so far.
[[nodiscard]] std::vector<ToldWarning> told_warnings();

// Logs those held back, of many the first.
void show_held_warnings();

}  // namespace meshrepair
