// SPDX-License-Identifier: MIT
// What programs do without on Windows and in WebAssembly: questions to the terminal, and the local
// page and the server of jobs, which start copies of the program. MESHREPAIR_WHERE says where, such
// as "on Windows".
#include <optional>
#include <string>
#include <string_view>

#include <base/error.h>

#include "jobs/work_off_jobs.h"
#include "process/exit_code.h"
#include "serve/serve.h"
#include "terminal/raw_terminal.h"

namespace meshrepair {
namespace {

int refuse(std::string_view flag) {
  return run_guarded("meshrepair", [&]() -> ExitCode {
    throw ValueError(std::string(flag) + ": cannot be used " MESHREPAIR_WHERE);
  });
}

}  // namespace

int serve(int /*argc*/, const char* const* /*argv*/) { return refuse(kServeFlag); }

int work_off_jobs(int /*argc*/, const char* const* /*argv*/, Program& /*program*/,
                  const std::function<int(int, const char* const*)>& /*run*/) {
  return refuse(kJobsFlag);
}

RawTerminal::RawTerminal() : descriptor_(-1) {}
RawTerminal::~RawTerminal() = default;
bool RawTerminal::write(std::string_view /*text*/) const { return false; }
std::optional<std::string> RawTerminal::read_until(Clock::time_point /*end*/) const { return {}; }
void restore_terminal() noexcept {}

}  // namespace meshrepair
