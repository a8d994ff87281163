// SPDX-License-Identifier: MIT
// Works off jobs as they are read, several at a time, each in a process of its own.
//
// Each job gets one answer, whatever becomes of it: a line of JSON, in the order in which they end.
//
//   id                 of the job
//   exit_code          of meshrepair; 128 and the number of a signal that killed it
//   signal             that number, else null
//   error              what ended it early, else null
//   peak_memory_bytes  of its process; null where there was none
//   stderr             what it printed, the end of it
//   report             as --report has it; null where there is none
//
// Nothing is lost and nothing grows: where answers are not read no job is begun, and where many
// jobs wait no line is read. Who reads answers only after writing a line is never stuck, as long as
// it waits for those of its jobs before it writes more of them than work at a time.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jobs/job_lines.h"
#include "jobs/job_process.h"
#include "process/exit_code.h"

namespace meshrepair {

class JobServer {
 public:
  // Runs a job, in a process that ends then: answers, and returns the exit code.
  using Work = std::function<int(const Job& job, const JobProcess::Answer& answer)>;

  // Reads `input`, a descriptor, and writes to standard output. Throws Error.
  JobServer(int input, std::size_t most_at_once, Work work);

  // Until all lines are read and answered. Returns what ended it otherwise: a signal, to which the
  // answers are that all jobs were ended, too; throws OutputError where nobody reads the answers.
  ExitCode run();

 private:
  struct Place {
    JobProcess process;
    Json id;
  };

  void begin_jobs();
  void begin(Place& place, const Job& job);
  void attend(int milliseconds = -1);
  [[nodiscard]] bool wants_input() const;
  void read_input();
  void take_line(std::string_view line);
  void cancel(const Cancellation& cancellation);
  void refuse(const Json& id, ExitCode code, const std::string& error);
  void finish(const Json& id, const JobProcess::Ended& ended);
  void write_answers();
  ExitCode end_all();

  int input_;
  Work work_;
  std::vector<Place> places_;
  std::size_t running_ = 0;
  std::string unread_;                               // the beginning of a line
  bool is_skipping_ = false;                         // what remains of a line that is too long
  std::deque<std::pair<Job, std::size_t>> waiting_;  // with the sizes of their lines
  std::size_t waiting_bytes_ = 0;
  std::size_t refused_bytes_ = 0;  // of lines whose answers have not all been written
  std::string answers_;            // from `written_` on they are to be written
  std::size_t written_ = 0;
};

}  // namespace meshrepair
