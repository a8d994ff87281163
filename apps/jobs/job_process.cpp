// SPDX-License-Identifier: MIT
// Copies write into files in memory, not into pipes: nobody has to read while they work, and two
// system calls take all.
#include "jobs/job_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <fcntl.h>
#include <poll.h>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <base/error.h>
#include <base/internal/processes.h>

namespace meshrepair {
namespace {

constexpr std::size_t kMostSaid = std::size_t{1} << 16;

int memory_file() {
  const int file = internal::nameless_file();
  if (file >= 0) return file;
  throw Error("no file in memory: " + std::generic_category().message(errno));
}

std::string bytes_in(int file, std::size_t first, std::size_t size) {
  std::string bytes(size, '\0');
  const ssize_t count = ::pread(file, bytes.data(), size, static_cast<off_t>(first));
  bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  return bytes;
}

// The end of what is in there, which is then empty again.
std::string taken_from(int file, std::size_t most) {
  struct stat status = {};
  if (::fstat(file, &status) != 0 || status.st_size <= 0) return {};
  const auto size = static_cast<std::size_t>(status.st_size);
  std::string bytes = bytes_in(file, size - std::min(size, most), std::min(size, most));
  ::lseek(file, 0, SEEK_SET);
  if (::ftruncate(file, 0) != 0) bytes.clear();
  return bytes;
}

// False: it is not written in full.
bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

// What was blocked before hold_signals().
sigset_t& signals_before() {
  static sigset_t before;
  return before;
}

}  // namespace

JobProcess::JobProcess() : answer_(memory_file()), said_(memory_file()) {}

JobProcess::JobProcess(JobProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      answer_(std::exchange(other.answer_, -1)),
      said_(std::exchange(other.said_, -1)) {}

JobProcess::~JobProcess() {
  if (is_running()) {
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
  }
  if (answer_ >= 0) ::close(answer_);
  if (said_ >= 0) ::close(said_);
}

void JobProcess::start(const Work& work, int closed) {
  is_told_to_end_ = is_killed_ = false;
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ > 0) return;
  if (process_ < 0) throw LimitError("no process: " + std::generic_category().message(errno));
  internal::end_with_parent();
  if (::getppid() != parent) ::_exit(127);
  ::close(closed);
  const int nothing = ::open("/dev/null", O_RDWR);  // NOLINT(bugprone-unused-return-value)
  ::dup2(nothing, STDIN_FILENO);
  if (nothing > STDERR_FILENO) ::close(nothing);
  ::dup2(said_, STDOUT_FILENO);
  ::dup2(said_, STDERR_FILENO);
  ::pthread_sigmask(SIG_SETMASK, &signals_before(), nullptr);
  // The line feed tells that all of it is there, whatever ends the process.
  const int code = work([this](std::string_view answer) {
    if (write_all(answer_, answer)) (void)write_all(answer_, "\n");
  });
  ::_exit(code);
}

void JobProcess::terminate(std::chrono::duration<double> grace) {
  if (!is_running()) return;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(grace);
  killed_at_ = is_told_to_end_ ? std::min(killed_at_, end) : end;
  if (!is_told_to_end_) ::kill(process_, SIGTERM);
  is_told_to_end_ = true;
}

int JobProcess::enforce() {
  if (!is_running() || !is_told_to_end_ || is_killed_) return -1;
  const auto left = killed_at_ - Clock::now();
  if (left > Clock::duration::zero()) {
    const auto rounded = std::chrono::ceil<std::chrono::milliseconds>(left).count();
    return static_cast<int>(std::min<long>(rounded, 1000));
  }
  ::kill(process_, SIGKILL);
  is_killed_ = true;
  return -1;
}

bool JobProcess::poll(Ended& ended) {
  if (!is_running()) return false;
  int status = 0;
  rusage usage = {};
  if (::wait4(process_, &status, WNOHANG, &usage) != process_) return false;
  process_ = -1;
  ended.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  ended.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  ended.peak_memory = internal::peak_memory_of(usage);
  ended.answer = taken_from(answer_, SIZE_MAX);
  ended.said = taken_from(said_, kMostSaid);
  if (ended.answer.ends_with('\n')) {
    ended.answer.pop_back();
  } else {
    ended.answer.clear();
  }
  return true;
}

// The handler has nothing to do but to be there.
void JobProcess::hold_signals() {
  struct sigaction action = {};
  action.sa_handler = [](int /*number*/) {};
  sigemptyset(&action.sa_mask);
  ::sigaction(SIGCHLD, &action, nullptr);
  sigset_t held;
  sigemptyset(&held);
  for (const int number : {SIGCHLD, SIGHUP, SIGINT, SIGTERM}) sigaddset(&held, number);
  ::pthread_sigmask(SIG_BLOCK, &held, &signals_before());
  sigdelset(&signals_before(), SIGCHLD);
}

JobProcess::Ready JobProcess::wait(int input, int output, bool is_more, int milliseconds) {
  const short events = is_more ? POLLOUT : 0;
  std::array<pollfd, 2> files = {{{input, POLLIN, 0}, {output, events, 0}}};
  if (internal::poll_with_signals(files, milliseconds, signals_before()) <= 0) return {};
  return {files[0].revents != 0, files[1].revents != 0};
}

}  // namespace meshrepair
