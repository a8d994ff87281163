// SPDX-License-Identifier: MIT
#include "serve/workshop.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <new>
#include <string_view>
#include <system_error>
#include <vector>

#include <base/error.h>
#include <mesh/soup_format.h>

#include "process/exit_code.h"
#include "program/command_files.h"
#include "serve/child_process.h"
#include "serve/guard.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kLongestName = 200;                     // bytes
constexpr std::size_t kLongestReport = std::size_t{1} << 26;  // a longer one is none
constexpr std::chrono::seconds kPatience(3);                  // from SIGTERM to SIGKILL

constexpr const char* kGone = "the folder of this server is gone: start it anew";

constexpr std::array<std::string_view, 6> kResults = {".stl", ".obj", ".off",
                                                      ".ply", ".glb", ".3mf"};
constexpr std::array<std::string_view, 15> kOpenOptions = {
    "for",      "inside",   "sew",   "seal", "holes", "max-hole", "thicken",  "min-part",
    "touching", "simplify", "units", "drop", "keep",  "cavities", "join-gaps"};
constexpr std::array<std::string_view, 2> kOpenFlags = {"always", "strict"};

template <class List>
bool is_among(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

void remove_folder(const fs::path& path) {
  std::error_code none;
  fs::remove_all(path, none);
}

bool is_full(const std::error_code& error) {
  return error == std::errc::no_space_on_device || error.value() == EDQUOT;
}

// No more is read than a report may have, whatever there is.
std::string read_report(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text, some(std::size_t{1} << 16, '\0');
  while (text.size() <= kLongestReport) {
    file.read(some.data(), static_cast<std::streamsize>(some.size()));
    const auto count = static_cast<std::size_t>(file.gcount());
    if (count == 0) return text;
    text.append(some, 0, count);
  }
  return {};
}

std::string without(std::string text, const std::string& part) {
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at)) {
    text.erase(at, part.size());
  }
  return text;
}

}  // namespace

bool is_mesh_name(const std::string& name) {
  if (name.empty() || name.size() > kLongestName || name.front() == '.' || name.front() == '-') {
    return false;
  }
  const bool is_plain = std::none_of(name.begin(), name.end(), [](char c) {
    return c == '/' || c == '\\' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
  });
  if (!is_plain) return false;
  // The name of what is in an archive is in there.
  return format_of_extension(name).has_value() || lower_extension(name) == ".zip";
}

bool is_result_extension(const std::string& extension) { return is_among(kResults, extension); }

bool is_open_option(const std::string& name) { return is_among(kOpenOptions, name); }

bool is_open_flag(const std::string& name) { return is_among(kOpenFlags, name); }

Workshop::Workshop(Options options, const OwnFolder& folder)
    : options_(std::move(options)), folder_(folder), worker_([this] { work(); }) {}

Workshop::~Workshop() {
  {
    const std::scoped_lock lock(mutex_);
    is_ending_ = true;
    changed_.notify_all();
  }
  worker_.join();
}

std::optional<Workshop::Intake> Workshop::begin(const std::string& name) {
  if (!is_mesh_name(name)) return std::nullopt;
  const std::scoped_lock lock(mutex_);
  make_room();
  if (jobs_.size() >= options_.most_jobs) return std::nullopt;
  Intake intake;
  intake.id = random_secret();
  make_folder(intake.id);
  Job job;
  job.state.name = name;
  job.state.phase = JobState::Phase::running;  // it is being handed in
  job.file = name;
  job.asked_for = Clock::now();
  jobs_.emplace(intake.id, std::move(job));
  intake.file = folder(intake.id) / "in" / name;
  return intake;
}

void Workshop::make_folder(const std::string& id) {
  std::error_code failed;
  do {
    fs::create_directory(folder(id), failed);
    if (!failed) fs::create_directory(folder(id) / "in", failed);
    if (!failed) return;
    remove_folder(folder(id));
  } while (is_full(failed) && drop_oldest());
  throw OutputError(is_full(failed) ? "there is no room for the mesh" : kGone);
}

void Workshop::discard(const Intake& intake) {
  const std::scoped_lock lock(mutex_);
  erase(intake.id);
}

void Workshop::add(const Intake& intake) {
  const std::scoped_lock lock(mutex_);
  const auto found = jobs_.find(intake.id);
  if (found == jobs_.end()) return;
  found->second.state.phase = JobState::Phase::waiting;
  queue_.push_back(intake.id);
  changed_.notify_all();
}

bool Workshop::free_room() {
  const std::scoped_lock lock(mutex_);
  return drop_oldest();
}

bool Workshop::repair(const std::string& id, const std::string& extension, ProgramOptions options) {
  const std::scoped_lock lock(mutex_);
  Job* const found = find(id);
  if (found == nullptr || found->state.phase != JobState::Phase::ended) return false;
  Job& job = *found;
  std::error_code none;
  if (!fs::exists(folder(id), none)) throw OutputError(kGone);
  fs::remove(folder(id) / "repair.html", none);
  remove_folder(folder(id) / "out");
  job.state = {job.state.name, Task::repair, JobState::Phase::waiting, {}, 0, 0, {}, false, false};
  job.extension = extension;
  job.options = std::move(options);
  job.cancelled = false;
  queue_.push_back(id);
  changed_.notify_all();
  return true;
}

void Workshop::cancel(const std::string& id) {
  const std::scoped_lock lock(mutex_);
  if (Job* const job = find(id)) job->cancelled = true;
}

void Workshop::remove(const std::string& id) {
  const std::scoped_lock lock(mutex_);
  Job* const job = find(id);
  if (job == nullptr) return;
  if (id != running_) return erase(id);
  job->cancelled = true;
  job->removed = true;
}

std::optional<JobState> Workshop::state(const std::string& id) {
  const std::scoped_lock lock(mutex_);
  Job* const job = find(id);
  if (job == nullptr) return std::nullopt;
  job->asked_for = Clock::now();
  return job->state;
}

fs::path Workshop::page_of(const std::string& id, Task task) {
  const std::scoped_lock lock(mutex_);
  if (find(id) == nullptr) return {};
  return folder(id) / (task == Task::check ? "check.html" : "repair.html");
}

std::optional<Workshop::Result> Workshop::result(const std::string& id) {
  const std::scoped_lock lock(mutex_);
  const Job* const job = find(id);
  if (job == nullptr || !job->state.has_result) return std::nullopt;
  const std::string stem = job->file.substr(0, job->file.find('.'));
  const std::string name = "mesh" + job->extension;
  return Result{folder(id) / "out" / name, stem + "_repaired" + job->extension};
}

Workshop::Job* Workshop::find(const std::string& id) {
  const auto found = jobs_.find(id);
  return found == jobs_.end() || found->second.removed ? nullptr : &found->second;
}

void Workshop::work() {
  std::unique_lock lock(mutex_);
  while (!is_ending_) {
    changed_.wait_for(lock, std::chrono::minutes(1),
                      [this] { return is_ending_ || !queue_.empty(); });
    if (is_ending_) return;
    if (queue_.empty()) {
      tidy_up();
      continue;
    }
    running_ = queue_.front();
    queue_.pop_front();
    const std::string id = running_;
    lock.unlock();
    run(id);
    lock.lock();
    running_.clear();
    const auto done = jobs_.find(id);
    if (done != jobs_.end() && done->second.removed) erase(id);
  }
}

// Whatever goes wrong is the end of this job alone.
void Workshop::run(const std::string& id) {
  try {
    std::vector<std::string> words;
    {
      const std::scoped_lock lock(mutex_);
      const auto found = jobs_.find(id);
      if (found == jobs_.end()) return;
      found->second.state.phase = JobState::Phase::running;
      words = command(id, found->second);
    }
    fs::create_directory(folder(id) / "out");
    follow(id, words);
  } catch (const std::exception&) {
    give_up(id);
  }
}

void Workshop::give_up(const std::string& id) noexcept {
  const std::scoped_lock lock(mutex_);
  const auto found = jobs_.find(id);
  if (found == jobs_.end()) return;
  JobState& state = found->second.state;
  state.phase = JobState::Phase::ended;
  state.exit_code = static_cast<int>(ExitCode::output);
  state.report.clear();
  state.has_page = state.has_result = false;
}

// It works in the folder of this, where no file needs to be named by more than this.
std::vector<std::string> Workshop::command(const std::string& id, const Job& job) const {
  const bool is_check = job.state.task == Task::check;
  std::vector<std::string> words = {options_.programs / (is_check ? "meshcheck" : "meshrepair")};
  words.insert(words.end(), options_.for_all.begin(), options_.for_all.end());
  words.push_back("--quiet");
  words.push_back("--report=" + id + "/report.json");
  words.push_back("--html=" + id + (is_check ? "/check.html" : "/repair.html"));
  if (!is_check) {
    for (const auto& [name, value] : job.options) {
      words.push_back("--" + name + (value.empty() ? "" : "=" + value));
    }
  }
  words.emplace_back("--");
  words.push_back(id + "/in/" + job.file);
  if (!is_check) words.push_back(id + "/out/mesh" + job.extension);
  return words;
}

void Workshop::follow(const std::string& id, const std::vector<std::string>& words) {
  std::error_code none;
  fs::remove(folder(id) / "report.json", none);
  ChildProcess child(words, folder_.descriptor());
  std::optional<Clock::time_point> told_to_end;
  while (child.wait()) {
    const std::scoped_lock lock(mutex_);
    Job& job = jobs_.at(id);
    std::tie(job.state.stage, job.state.percent) = child.progress();
    if (!told_to_end && (job.cancelled || is_ending_)) {
      child.terminate();
      told_to_end = Clock::now();
    }
    if (told_to_end && Clock::now() > *told_to_end + kPatience) child.kill();
  }
  finish(id, child.exit_code());
}

void Workshop::finish(const std::string& id, int code) {
  // Where files lie here is nobody's business. There is nothing in these names that JSON escapes.
  std::string report = read_report(folder(id) / "report.json");
  report = without(without(without(report, id + "/in/"), id + "/out/"), id + "/");
  const std::scoped_lock lock(mutex_);
  Job& job = jobs_.at(id);
  JobState& state = job.state;
  const bool is_check = state.task == Task::check;
  std::error_code none;
  state.has_page = fs::exists(folder(id) / (is_check ? "check.html" : "repair.html"), none);
  state.has_result = !is_check && fs::exists(folder(id) / "out" / ("mesh" + job.extension), none);
  state.report = std::move(report);
  state.exit_code = code;
  state.phase = JobState::Phase::ended;
}

// Those that have ended, first the one that nobody has asked for the longest.
std::vector<Workshop::Asked> Workshop::idle_jobs() const {
  std::vector<Asked> idle;
  for (const auto& [id, job] : jobs_) {
    if (job.state.phase == JobState::Phase::ended && id != running_) {
      idle.emplace_back(job.asked_for, id);
    }
  }
  std::sort(idle.begin(), idle.end());
  return idle;
}

// The oldest that nobody has asked for, for long or at all, go.
void Workshop::make_room() {
  const auto now = Clock::now();
  for (const auto& [asked_for, id] : idle_jobs()) {
    if (jobs_.size() < options_.most_jobs && now < asked_for + options_.lifetime) return;
    erase(id);
  }
}

// Later, where memory is short.
void Workshop::tidy_up() noexcept {
  try {
    make_room();
  } catch (const std::bad_alloc&) {
    return;
  }
}

bool Workshop::drop_oldest() {
  const std::vector<Asked> idle = idle_jobs();
  if (idle.empty()) return false;
  erase(idle.front().second);
  return true;
}

void Workshop::erase(const std::string& id) {
  if (jobs_.erase(id) == 0) return;
  queue_.erase(std::remove(queue_.begin(), queue_.end(), id), queue_.end());
  remove_folder(folder(id));
}

}  // namespace meshrepair
