// SPDX-License-Identifier: MIT
#include "serve/child_process.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <string_view>
#include <sys/wait.h>
#include <unistd.h>

#include <base/error.h>
#include <base/internal/processes.h>

namespace meshrepair {
namespace {

constexpr int kProgressDescriptor = 3;  // in the child
constexpr int kWaitMilliseconds = 100;
constexpr std::size_t kLongestLine = 1024;

// In the child, between fork and exec: only what signal handlers may do, too.
[[noreturn]] void become(char* const* words, int told, int folder, pid_t parent) {
  internal::end_with_parent();
  if (::getppid() != parent || ::fchdir(folder) != 0) ::_exit(127);
  const int nothing = ::open("/dev/null", O_RDWR);  // NOLINT(bugprone-unused-return-value)
  for (const int stream : {0, 1, 2}) ::dup2(nothing, stream);
  ::dup2(told, kProgressDescriptor);  // without FD_CLOEXEC, unless it is there already
  if (told == kProgressDescriptor) ::fcntl(told, F_SETFD, 0);
  struct sigaction action = {};
  action.sa_handler = SIG_DFL;
  for (const int number : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE, SIGXFSZ}) {
    ::sigaction(number, &action, nullptr);
  }
  ::execv(words[0], words);
  ::_exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, int folder) {
  std::vector<std::string> all = command;
  all.insert(all.begin() + 1, "--progress-fd=" + std::to_string(kProgressDescriptor));
  std::vector<char*> words;
  words.reserve(all.size() + 1);
  for (std::string& word : all) words.push_back(word.data());
  words.push_back(nullptr);
  std::array<int, 2> ends{};
  if (!internal::open_pipe(ends)) {
    throw Error(std::string("no pipe: ") + std::strerror(errno));  // NOLINT(concurrency-mt-unsafe)
  }
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) become(words.data(), ends[1], folder, parent);
  ::close(ends[1]);
  told_ = ends[0];
  if (process_ > 0) return;
  const int reason = errno;
  ::close(told_);
  throw Error("no process: " +
              std::string(std::strerror(reason)));  // NOLINT(concurrency-mt-unsafe)
}

ChildProcess::~ChildProcess() {
  if (exit_code_ < 0) {
    kill();
    reap();
  }
  ::close(told_);
}

bool ChildProcess::wait() {
  if (exit_code_ >= 0) return false;
  pollfd wait = {told_, POLLIN, 0};
  if (::poll(&wait, 1, kWaitMilliseconds) <= 0) return true;
  std::array<char, 4096> some{};
  const ssize_t count = ::read(told_, some.data(), some.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return true;
  if (count <= 0) {
    reap();
    return false;
  }
  unread_.append(some.data(), static_cast<std::size_t>(count));
  take_lines();
  return true;
}

// "arrange 43\n"; of several the last one counts.
void ChildProcess::take_lines() {
  for (std::size_t end = unread_.find('\n'); end != std::string::npos; end = unread_.find('\n')) {
    const std::string_view line = std::string_view(unread_).substr(0, end);
    const std::size_t gap = line.rfind(' ');
    int percent = 0;
    if (gap != std::string_view::npos &&
        std::from_chars(line.data() + gap + 1, line.data() + end, percent).ec == std::errc()) {
      progress_ = {std::string(line.substr(0, gap)), percent};
    }
    unread_.erase(0, end + 1);
  }
  if (unread_.size() > kLongestLine) unread_.clear();
}

void ChildProcess::terminate() const {
  if (exit_code_ < 0) ::kill(process_, SIGTERM);
}

void ChildProcess::kill() const {
  if (exit_code_ < 0) ::kill(process_, SIGKILL);
}

void ChildProcess::reap() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace meshrepair
