// SPDX-License-Identifier: MIT
#include "jobs/job_server.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <optional>
#include <system_error>
#include <unistd.h>
#include <variant>

#include <climits>
#include <spdlog/fmt/fmt.h>

#include <base/error.h>

#include "process/signals.h"

namespace meshrepair {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kLongestLine = std::size_t{1} << 20;
constexpr std::size_t kReadAtOnce = std::size_t{1} << 16;
constexpr std::size_t kMostLinesAhead = std::size_t{1} << 18;  // bytes of those that wait
constexpr std::size_t kMostAnswersAhead = std::size_t{1} << 22;
constexpr std::chrono::seconds kGrace(3);     // that a signal leaves to jobs
constexpr std::chrono::seconds kPatience(3);  // with a reader of the last answers
constexpr int kMillisecondsBetween = 100;     // looks at that time

// Who is ended by its watchdog has said why, but answered nothing.
std::string last_line(std::string_view said) {
  said = said.substr(0, said.find_last_not_of('\n') + 1);
  return std::string(said.substr(said.rfind('\n') + 1));
}

}  // namespace

JobServer::JobServer(int input, std::size_t most_at_once, Work work)
    : input_(input), work_(std::move(work)), places_(most_at_once) {}

ExitCode JobServer::run() {
  JobProcess::hold_signals();
  while (input_ >= 0 || running_ > 0 || !waiting_.empty() || written_ < answers_.size()) {
    begin_jobs();
    attend();
    if (received_signal() != 0) return end_all();
  }
  return ExitCode::done;
}

void JobServer::begin_jobs() {
  for (Place& place : places_) {
    if (waiting_.empty() || answers_.size() - written_ > kMostAnswersAhead) return;
    if (place.process.is_running()) continue;
    const auto [job, size] = std::move(waiting_.front());
    waiting_.pop_front();
    waiting_bytes_ -= size;
    begin(place, job);
  }
}

void JobServer::begin(Place& place, const Job& job) {
  place.id = job.id;
  try {
    place.process.start([&](const JobProcess::Answer& answer) { return work_(job, answer); },
                        input_);
    ++running_;
  } catch (const LimitError& error) {
    refuse(job.id, ExitCode::limit, error.what());
  }
}

// Waits for something to happen, and does what it asks for.
void JobServer::attend(int milliseconds) {
  for (Place& place : places_) {
    const int left = place.process.enforce();
    if (left >= 0) milliseconds = milliseconds < 0 ? left : std::min(milliseconds, left);
  }
  const JobProcess::Ready ready = JobProcess::wait(wants_input() ? input_ : -1, STDOUT_FILENO,
                                                   written_ < answers_.size(), milliseconds);
  if (ready.output) write_answers();
  if (ready.input) read_input();
  for (Place& place : places_) {
    JobProcess::Ended ended;
    if (!place.process.poll(ended)) continue;
    --running_;
    finish(place.id, ended);
  }
}

// Cancellations come by the same way, so it is read on although no job can be begun.
bool JobServer::wants_input() const { return waiting_bytes_ + refused_bytes_ < kMostLinesAhead; }

void JobServer::read_input() {
  std::array<char, kReadAtOnce> some{};
  const ssize_t count = ::read(input_, some.data(), some.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return;
  if (count <= 0) {
    ::close(std::exchange(input_, -1));
    if (!unread_.empty()) take_line(unread_);  // without a line feed
    unread_.clear();
    return;
  }
  std::string_view text(some.data(), static_cast<std::size_t>(count));
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    unread_ += text.substr(0, end);
    if (!std::exchange(is_skipping_, false)) take_line(unread_);
    unread_.clear();
    text.remove_prefix(end + 1);
  }
  if (is_skipping_) return;
  unread_ += text;
  if (unread_.size() <= kLongestLine) return;
  is_skipping_ = true;
  unread_.clear();
  refuse({}, ExitCode::usage, "the line is longer than 1 MiB");
}

void JobServer::take_line(std::string_view line) {
  if (line.find_first_not_of(" \t\r") == std::string_view::npos) return;
  JobLine read = read_job_line(line);
  if (const auto* const wrong = std::get_if<WrongLine>(&read)) {
    refuse(wrong->id, ExitCode::usage, wrong->why);
  } else if (const auto* const cancellation = std::get_if<Cancellation>(&read)) {
    cancel(*cancellation);
  } else {
    waiting_bytes_ += line.size();
    waiting_.emplace_back(std::move(std::get<Job>(read)), line.size());
  }
}

void JobServer::cancel(const Cancellation& cancellation) {
  const std::string id = cancellation.id.dump();
  for (Place& place : places_) {
    if (!place.process.is_running() || place.id.dump() != id) continue;
    place.process.terminate(std::chrono::duration<double>(cancellation.grace));
  }
  std::erase_if(waiting_, [&](const auto& waiting) {
    if (waiting.first.id.dump() != id) return false;
    waiting_bytes_ -= waiting.second;
    refuse(waiting.first.id, ExitCode::terminated, "cancelled before it was begun");
    return true;
  });
}

// An answer without a process.
void JobServer::refuse(const Json& id, ExitCode code, const std::string& error) {
  const Json answer = {
      {"id", id},         {"exit_code", static_cast<int>(code)}, {"signal", nullptr},
      {"error", error},   {"peak_memory_bytes", nullptr},        {"stderr", ""},
      {"report", nullptr}};
  const std::string line = answer.dump() + '\n';
  refused_bytes_ += line.size();
  answers_ += line;
}

// The answer of the process has the error and the report.
void JobServer::finish(const Json& id, const JobProcess::Ended& ended) {
  std::string rest = ended.answer;
  if (ended.signal != 0) {
    rest = fmt::format(R"("error":"killed by signal {}","report":null)", ended.signal);
  } else if (rest.empty()) {
    const Json error = ended.exit_code == 0 ? Json() : Json(last_line(ended.said));
    rest = fmt::format(R"("error":{},"report":null)", error.dump());
  }
  answers_ += fmt::format(
      R"({{"id":{},"exit_code":{},"signal":{},"peak_memory_bytes":{},"stderr":{},{}}})", id.dump(),
      ended.exit_code, ended.signal != 0 ? std::to_string(ended.signal) : "null", ended.peak_memory,
      Json(ended.said).dump(), rest);
  answers_ += '\n';
}

// A pipe that is ready takes so much without waiting.
void JobServer::write_answers() {
  const std::string_view rest = std::string_view(answers_).substr(written_);
  if (rest.empty()) throw OutputError("standard output: nobody reads it");
  const ssize_t count =
      ::write(STDOUT_FILENO, rest.data(), std::min<std::size_t>(rest.size(), PIPE_BUF));
  if (count < 0 && errno != EINTR && errno != EAGAIN) {
    throw OutputError("standard output: cannot be written: " +
                      std::generic_category().message(errno));
  }
  written_ += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  if (written_ == answers_.size()) refused_bytes_ = 0;
  if (written_ < answers_.size() && written_ < kMostAnswersAhead) return;
  answers_.erase(0, written_);
  written_ = 0;
}

ExitCode JobServer::end_all() {
  if (input_ >= 0) ::close(std::exchange(input_, -1));
  for (const auto& [job, size] : waiting_) {
    refuse(job.id, failure_of_signal()->code, failure_of_signal()->message);
  }
  waiting_.clear();
  for (Place& place : places_) place.process.terminate(kGrace);
  while (running_ > 0) attend();
  const auto end = Clock::now() + kPatience;
  while (written_ < answers_.size() && Clock::now() < end) attend(kMillisecondsBetween);
  return failure_of_signal()->code;
}

}  // namespace meshrepair
