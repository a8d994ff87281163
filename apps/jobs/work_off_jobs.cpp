// SPDX-License-Identifier: MIT
#include "jobs/work_off_jobs.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <base/internal/system.h>

#include "jobs/job_server.h"
#include "options/command_line.h"
#include "options/numbers.h"
#include "process/exit_code.h"
#include "process/signals.h"
#include "terminal/logging.h"

namespace meshrepair {
namespace {

constexpr std::size_t kMostJobs = 9999;
constexpr double kShareOfMemory = 80;  // percent, of all jobs together

constexpr const char* kFooter =
    R"(Further options are those of all jobs: see meshrepair --help. Without them a job has one thread, and
its share of 80 % of the memory.

A job is a line of JSON. "options" may be left out. A text that is not UTF-8 is {"base64": "..."}.
  {"id": 7, "in": "broken.stl", "out": "repaired.stl", "options": ["--for", "print"]}
Each gets one answer on standard output, in the order in which they end:
  {"id": 7, "exit_code": 0, "signal": null, "peak_memory_bytes": 10600000, "stderr": "",
   "error": null, "report": {...}}
To end a job, after so many seconds by force:
  {"cancel": 7, "grace": 3}

The exit code is 0 if all lines were answered, whatever became of the jobs.

Examples:
  meshrepair --jobs-from jobs.jsonl > answers.jsonl
  meshrepair --jobs-from - --jobs 4 --quiet --time-limit 60)";

struct JobsOptions {
  std::string file;
  std::size_t most_at_once = 0;     // 0: as many as there are cores
  std::vector<std::string> of_all;  // options of all jobs
};

void add_options(CommandLine& app, JobsOptions& options) {
  app.add_option(std::string(kJobsFlag), options.file,
                 "File of jobs, one in each line; - is standard input")
      ->type_name("FILE")
      ->required();
  app.add_option("--jobs", options.most_at_once, "Number of jobs at a time; 0: the cores")
      ->capture_default_str()
      ->check(count_between(0, kMostJobs))
      ->type_name("N");
  app.set_help_flag("--help,-h", "Print this help and exit");
  app.set_footer(kFooter);
}

// Those of this command come first: the others belong to the jobs. Nothing: help was asked for, and
// is printed.
std::vector<std::string> own_words(const std::vector<std::string>& words) {
  const auto asks_for_help = [&](std::size_t at) {
    return at < words.size() && (words[at] == "--help" || words[at] == "-h");
  };
  if (asks_for_help(1)) return {words[1]};
  std::size_t count = words[0] == kJobsFlag ? 2 : 1;  // with the file
  if (count < words.size() && words[count].starts_with("--jobs=")) count += 1;
  if (count < words.size() && words[count] == "--jobs") count += 2;
  if (asks_for_help(count)) count += 1;
  return {words.begin(),
          words.begin() + static_cast<std::ptrdiff_t>(std::min(count, words.size()))};
}

// False: help was asked for, and is printed.
bool parse(int argc, const char* const* argv, JobsOptions& options) {
  CommandLine app("Repairs the meshes of many jobs, each in a process of its own.",
                  "meshrepair --jobs-from");
  add_options(app, options);
  const std::vector<std::string> words(argv + 1, argv + argc);
  const std::vector<std::string> own = own_words(words);
  options.of_all.assign(words.begin() + static_cast<std::ptrdiff_t>(own.size()), words.end());
  if (app.parse(own) != CommandLine::Parsed::all) {
    std::fputs(app.help().c_str(), stdout);
    return false;
  }
  if (options.most_at_once == 0) {
    options.most_at_once = std::max<std::size_t>(1, std::thread::hardware_concurrency());
  }
  return true;
}

CommonOptions defaults_of_jobs(std::size_t most_at_once) {
  CommonOptions defaults;
  defaults.threads = 1;
  defaults.hands_report = true;
  defaults.max_memory = fmt::format("{:.3g}%", kShareOfMemory / static_cast<double>(most_at_once));
  return defaults;
}

int opened(const std::string& file) {
  if (file == "-") return STDIN_FILENO;
  const int input = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (input >= 0) return input;
  throw InputError(file + ": cannot be opened: " + std::generic_category().message(errno));
}

// Starts this program anew, with all functions of libraries bound: else each job binds those that
// it calls, which is a sixth of the time of a small one. A start that does it takes longer, so that
// of one mesh does not.
void bind_all_functions(const char* const* argv) {
  constexpr const char* kBindNow = "LD_BIND_NOW";
  if (std::getenv(kBindNow) != nullptr) return;  // NOLINT(concurrency-mt-unsafe): one thread
  std::error_code error;
  const std::string self = std::filesystem::canonical(internal::program_file(), error).string();
  if (error || ::setenv(kBindNow, "1", 0) != 0) return;  // NOLINT(concurrency-mt-unsafe)
  ::execv(self.c_str(), const_cast<char* const*>(argv));
}

std::vector<std::string> words_of(const std::string& name, const JobsOptions& options,
                                  const Job& job) {
  std::vector<std::string> words = {name};
  words.insert(words.end(), options.of_all.begin(), options.of_all.end());
  words.insert(words.end(), job.options.begin(), job.options.end());
  words.insert(words.end(), {"--", job.in, job.out});
  return words;
}

int run_words(const std::vector<std::string>& words,
              const std::function<int(int, const char* const*)>& run) {
  std::vector<const char*> pointers(words.size());
  std::transform(words.begin(), words.end(), pointers.begin(),
                 [](const std::string& word) { return word.c_str(); });
  return run(static_cast<int>(pointers.size()), pointers.data());
}

// The part of it that the job knows.
std::string answer_of(const Json& report) {
  const Json* const error = report.find("error");
  return "\"error\":" + (error == nullptr ? "null" : error->dump()) +
         ",\"report\":" + report.dump();
}

}  // namespace

int work_off_jobs(int argc, const char* const* argv, Program& program,
                  const std::function<int(int, const char* const*)>& run) {
  return run_guarded("meshrepair", [&] {
    install_signal_handlers();
    set_up_logging("meshrepair", Verbosity::normal);
    JobsOptions options;
    try {
      if (!parse(argc, argv, options)) return ExitCode::done;
    } catch (const UsageError& error) {  // another help says more
      throw ValueError(std::string(error.what()) + " (try 'meshrepair --jobs-from --help')");
    }
    bind_all_functions(argv);
    program.add_common_options(defaults_of_jobs(options.most_at_once));
    const auto work = [&](const Job& job, const JobProcess::Answer& answer) {
      program.hand_report_to([&](const Json& report) { answer(answer_of(report)); });
      return run_words(words_of(argv[0], options, job), run);
    };
    JobServer server(opened(options.file), options.most_at_once, work);
    return server.run();
  });
}

}  // namespace meshrepair
