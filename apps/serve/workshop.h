// SPDX-License-Identifier: MIT
// The meshes that were handed in, and what is done with them: one piece of work after the other,
// each by a program of ours as a process of its own.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "serve/own_folder.h"

namespace meshrepair {

// What is done with a mesh: meshcheck, or meshrepair with these options.
enum class Task { check, repair };
using ProgramOptions = std::vector<std::pair<std::string, std::string>>;  // "for", "print"

// What a mesh has been handed in for, and what came of it.
struct JobState {
  enum class Phase { waiting, running, ended };

  std::string name;  // of the mesh, as whoever handed it in has it
  Task task = Task::check;
  Phase phase = Phase::waiting;
  std::string stage;
  int percent = 0;
  int exit_code = 0;        // once it has ended
  std::string report;       // JSON, once it has ended; empty: there is none
  bool has_result = false;  // a repaired mesh
  bool has_page = false;    // of the last task
};

class Workshop {
 public:
  struct Options {
    std::filesystem::path programs;      // the folder of meshrepair and meshcheck
    std::vector<std::string> for_all;    // options for each of them: "--threads=2"
    std::size_t most_jobs = 50;          // of more, the oldest that has ended goes
    std::chrono::minutes lifetime{240};  // of a job that nobody asks for
  };

  // Works in this folder, which is not owned.
  Workshop(Options options, const OwnFolder& folder);
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;
  // Ends what runs.
  ~Workshop();

  // Where a mesh of that name is to be written, in a folder of its own; nothing where it is no name
  // of a mesh file, or there are too many jobs. Then either add() or discard() is to be called.
  // Throws OutputError where the disk is full, or the folder of this is gone.
  struct Intake {
    std::string id;
    std::filesystem::path file;
  };
  [[nodiscard]] std::optional<Intake> begin(const std::string& name);
  void discard(const Intake& intake);
  // The disk is full: removes the job that has ended and that nobody has asked for the longest.
  // False: there is none.
  [[nodiscard]] bool free_room();
  // The first task is a check.
  void add(const Intake& intake);

  // False: there is no such job, or it is at work. Throws OutputError where its folder is gone.
  [[nodiscard]] bool repair(const std::string& id, const std::string& extension,
                            ProgramOptions options);
  // Ends what is done with it, which may take a moment. The mesh stays.
  void cancel(const std::string& id);
  // From now on there is no such job; what is done with it ends in a moment.
  void remove(const std::string& id);

  // Nothing: there is no such job.
  [[nodiscard]] std::optional<JobState> state(const std::string& id);
  [[nodiscard]] std::filesystem::path page_of(const std::string& id, Task task);
  // Nothing: there is none. The name is for whoever gets it.
  struct Result {
    std::filesystem::path file;
    std::string name;
  };
  [[nodiscard]] std::optional<Result> result(const std::string& id);

 private:
  struct Job {
    JobState state;
    std::string file;       // name of it in its folder
    std::string extension;  // of the result
    ProgramOptions options;
    bool cancelled = false;
    bool removed = false;  // it is at work, and goes when that has ended
    std::chrono::steady_clock::time_point asked_for;
  };

  [[nodiscard]] Job* find(const std::string& id);
  void make_folder(const std::string& id);
  using Asked = std::pair<std::chrono::steady_clock::time_point, std::string>;  // when, for which
  [[nodiscard]] std::vector<Asked> idle_jobs() const;
  [[nodiscard]] bool drop_oldest();
  void work();
  void run(const std::string& id);
  [[nodiscard]] std::vector<std::string> command(const std::string& id, const Job& job) const;
  void follow(const std::string& id, const std::vector<std::string>& command);
  void finish(const std::string& id, int code);
  void give_up(const std::string& id) noexcept;
  void make_room();
  void tidy_up() noexcept;
  void erase(const std::string& id);
  [[nodiscard]] std::filesystem::path folder(const std::string& id) const {
    return folder_.path() / id;
  }

  Options options_;
  const OwnFolder& folder_;
  std::mutex mutex_;  // for all that follows
  std::condition_variable changed_;
  std::map<std::string, Job> jobs_;
  std::deque<std::string> queue_;
  std::string running_;
  bool is_ending_ = false;
  std::thread worker_;
};

// Whether a mesh may have this name: that of a file, without folders, of a mesh by its extension.
[[nodiscard]] bool is_mesh_name(const std::string& name);
// ".stl" and so on, that results may have.
[[nodiscard]] bool is_result_extension(const std::string& extension);
// Which options of meshrepair may be asked for: none of them names a file. Those with a value, and
// those without: one that lacks its value would take the next word of the command for it.
[[nodiscard]] bool is_open_option(const std::string& name);
[[nodiscard]] bool is_open_flag(const std::string& name);

}  // namespace meshrepair
