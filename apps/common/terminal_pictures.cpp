#include "common/terminal_pictures.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <poll.h>
#include <string>
#include <string_view>
#include <termios.h>
#include <unistd.h>

#include "common/logging.h"

namespace meshrepair {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPatience = std::chrono::seconds(1);
constexpr std::size_t kLongestAnswer = 4096;
// Whether kitty's pictures are known, by one of a pixel that is not shown. Then what the terminal
// is, which all of them answer, and after the first answer.
constexpr std::string_view kQuestion = "\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\\x1b[c";
constexpr std::string_view kKittyAnswer = "\x1b_Gi=31;OK";
constexpr std::string_view kAttributes = "\x1b[?";  // of the terminal, up to "c": "\x1b[?62;4;22c"
constexpr std::string_view kSixelAttribute = "4";

// The terminal itself, whatever the standard streams are, without echo and without waiting for
// whole lines as long as this lives.
class RawTerminal {
 public:
  RawTerminal() : descriptor_(::open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    if (descriptor_ < 0) return;
    // Others would be stopped.
    is_ready_ = ::tcgetpgrp(descriptor_) == ::getpgrp() && ::tcgetattr(descriptor_, &before_) == 0;
    if (!is_ready_) return;
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    raw.c_cc[VMIN] = 0;
    raw.c_cc[VTIME] = 0;
    is_ready_ = ::tcsetattr(descriptor_, TCSANOW, &raw) == 0;
  }
  ~RawTerminal() {
    if (is_ready_) (void)::tcsetattr(descriptor_, TCSANOW, &before_);
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  [[nodiscard]] bool is_ready() const { return is_ready_; }

  [[nodiscard]] bool write(std::string_view text) const {
    return ::write(descriptor_, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  }

  // Some of what has come until then; empty: nothing has.
  [[nodiscard]] std::string read_until(Clock::time_point end) const {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    pollfd wait = {descriptor_, POLLIN, 0};
    if (left.count() <= 0 || ::poll(&wait, 1, static_cast<int>(left.count())) <= 0) return {};
    std::array<char, 256> some{};
    const ssize_t count = ::read(descriptor_, some.data(), some.size());
    return count > 0 ? std::string(some.data(), static_cast<std::size_t>(count)) : std::string();
  }

 private:
  int descriptor_;
  bool is_ready_ = false;
  termios before_{};
};

// The list between "\x1b[?" and "c"; empty: it has not come.
std::string_view attributes_in(std::string_view answer) {
  const std::size_t begin = answer.find(kAttributes);
  if (begin == std::string_view::npos) return {};
  const std::string_view rest = answer.substr(begin + kAttributes.size());
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

TerminalPictures ask_terminal_for_pictures() {
  if (!stderr_is_terminal()) return TerminalPictures::none;
  const RawTerminal terminal;
  if (!terminal.is_ready() || !terminal.write(kQuestion)) return TerminalPictures::none;
  const Clock::time_point end = Clock::now() + kPatience;
  std::string answer;
  while (attributes_in(answer).empty() && answer.size() < kLongestAnswer) {
    const std::string more = terminal.read_until(end);
    if (more.empty()) break;
    answer += more;
  }
  if (answer.find(kKittyAnswer) != std::string::npos) return TerminalPictures::kitty;
  return has_attribute(attributes_in(answer), kSixelAttribute) ? TerminalPictures::sixel
                                                               : TerminalPictures::none;
}

}  // namespace meshrepair
