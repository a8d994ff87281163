// SPDX-License-Identifier: MIT
#include "terminal/terminal_pictures.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include <base/error.h>

#include "terminal/logging.h"
#include "terminal/raw_terminal.h"

namespace meshrepair {
namespace {

using Clock = RawTerminal::Clock;

constexpr auto kPatience = std::chrono::seconds(1);
constexpr auto kBetweenQuestions = std::chrono::milliseconds(50);  // whether to go on
constexpr std::size_t kLongestAnswer = 4096;
// Whether kitty's pictures are known, by one of a pixel that is not shown. Then what the terminal
// is, which all of them answer, and after the first answer.
constexpr std::string_view kQuestion = "\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\\x1b[c";
constexpr std::string_view kKittyAnswer = "\x1b_Gi=31;OK";
constexpr std::string_view kTerminalAttributes =
    "\x1b[?";  // of the terminal, up to "c": "\x1b[?62;4;22c"
constexpr std::string_view kSixelAttribute = "4";

// The list between "\x1b[?" and "c"; empty: it has not come.
std::string_view attributes_in(std::string_view answer) {
  const std::size_t begin = answer.find(kTerminalAttributes);
  if (begin == std::string_view::npos) return {};
  const std::string_view rest = answer.substr(begin + kTerminalAttributes.size());
  const std::size_t end = rest.find('c');
  return end == std::string_view::npos ? std::string_view() : rest.substr(0, end);
}

bool has_attribute(std::string_view list, std::string_view wanted) {
  while (!list.empty()) {
    const std::size_t end = list.find(';');
    if (list.substr(0, end) == wanted) return true;
    if (end == std::string_view::npos) return false;
    list.remove_prefix(end + 1);
  }
  return false;
}

}  // namespace

TerminalPictures ask_terminal_for_pictures(ProgressObserver& progress) {
  if (!stderr_is_terminal()) return TerminalPictures::none;
  const RawTerminal terminal;
  if (!terminal.is_ready() || !terminal.write(kQuestion)) return TerminalPictures::none;
  const Clock::time_point end = Clock::now() + kPatience;
  std::string answer;
  while (attributes_in(answer).empty() && answer.size() < kLongestAnswer && Clock::now() < end) {
    const auto more = terminal.read_until(std::min(end, Clock::now() + kBetweenQuestions));
    if (progress.cancelled()) throw Cancelled();
    if (!more) break;
    answer += *more;
  }
  if (answer.find(kKittyAnswer) != std::string::npos) return TerminalPictures::kitty;
  return has_attribute(attributes_in(answer), kSixelAttribute) ? TerminalPictures::sixel
                                                               : TerminalPictures::none;
}

}  // namespace meshrepair
