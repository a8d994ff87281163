// SPDX-License-Identifier: MIT
#include "serve/serve.h"

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <base/internal/system.h>

#include "options/command_line.h"
#include "options/numbers.h"
#include "process/exit_code.h"
#include "process/memory_limit.h"
#include "process/signals.h"
#include "program/common_options.h"
#include "serve/http_server.h"
#include "terminal/logging.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

struct ServeOptions {
  std::size_t port = 0;
  std::string max_upload = "2G";
  bool opens_browser = true;
  // Of the programs.
  std::string threads, time_limit, max_memory;
};

void add_options(CommandLine& app, ServeOptions& options) {
  app.add_flag_callback(
      std::string(kServeFlag), [] {}, "Serve a local web page until Ctrl-C");
  app.add_option("--port", options.port, "Port; 0: any free one")
      ->check(count_between(0, 65535))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--max-upload", options.max_upload, "Refuse larger meshes: 200M, 2G")
      ->type_name("SIZE")
      ->capture_default_str();
  app.add_flag_callback(
      "--no-browser", [&options] { options.opens_browser = false; },
      "Print the address and do not open a browser");
  app.add_option("--threads", options.threads, "Number of threads of a repair; 0: all")
      ->check(count_between(0, kMostThreads))
      ->type_name("N");
  app.add_option("--time-limit", options.time_limit,
                 "Stop a check or repair after this time; 0: no limit")
      ->check(number_between(0))
      ->type_name("SECONDS");
  app.add_option("--max-memory", options.max_memory, "Memory limit of a check or repair: 200M, 80%")
      ->type_name("SIZE");
}

// False: help was asked for, and is printed.
bool parse(CommandLine& app, int argc, const char* const* argv) {
  app.set_help_flag("--help,-h", "Print this help and exit");
  app.set_footer(
      "Examples:\n"
      "  meshrepair --serve\n"
      "  meshrepair --serve --port 8080 --no-browser --max-memory 8G");
  if (app.parse(argc, argv) == CommandLine::Parsed::all) return true;
  std::fputs(app.help().c_str(), stdout);
  return false;
}

fs::path folder_of_programs() {
  std::error_code error;
  fs::path folder = fs::canonical(internal::program_file(), error).parent_path();
  if (error || !fs::exists(folder / "meshcheck", error)) {
    throw UsageError("--serve: there is no meshcheck beside this program");
  }
  return folder;
}

std::vector<std::string> options_for_all(const ServeOptions& options) {
  std::vector<std::string> words;
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) words.push_back(std::string(name) + "=" + value);
  };
  add("--threads", options.threads);
  add("--time-limit", options.time_limit);
  add("--max-memory", options.max_memory);
  return words;
}

// By a file that only this user can read: all users see the arguments of processes, and the address
// has the token. The browser makes files as it would without us.
void open_browser(const std::string& address, const OwnFolder& folder, ::mode_t mask) {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): never changed
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  const std::string file = folder.name() + "/open.html";
  std::ofstream(folder.path() / "open.html")
      << R"(<!doctype html><meta http-equiv="refresh" content="0; url=)" << address << "\">\n";
  const pid_t child = ::fork();
  if (child == 0) {
    ::umask(mask);
    if (::fork() == 0) {  // whose parent ends at once, so that nobody has to wait for it
      ::execlp("xdg-open", "xdg-open", file.c_str(), nullptr);
      ::_exit(127);
    }
    ::_exit(0);
  }
  if (child > 0) ::waitpid(child, nullptr, 0);
}

ExitCode serve_until_signal(const ServeOptions& options) {
  // Else each mesh would fail.
  if (!options.max_memory.empty()) (void)parse_memory_limit(options.max_memory);
  const ::mode_t mask = ::umask(077);  // the programs that are started keep to it, too
  const std::string token = random_secret();
  Workshop::Options of_workshop;
  of_workshop.programs = folder_of_programs();
  of_workshop.for_all = options_for_all(options);
  HttpServer::Limits limits;
  limits.body = parse_size(options.max_upload, "--max-upload");
  if (limits.body == 0) throw UsageError("--max-upload: must be more than 0");
  HttpServer server(static_cast<unsigned short>(options.port));
  const OwnFolder folder("meshrepair-serve");
  Workshop workshop(std::move(of_workshop), folder);
  const Guard guard(server.port(), token);
  const Answers answers(guard, workshop);
  const std::string address = fmt::format("http://127.0.0.1:{}/#{}", server.port(), token);
  fmt::print("{}\n", address);
  std::fflush(stdout);
  print_summary("meshrepair: open this address in a browser on this machine; Ctrl-C ends it\n");
  if (options.opens_browser) open_browser(address, folder, mask);
  server.serve(answers, limits, [] { return received_signal() != 0; });
  return ExitCode::done;
}

}  // namespace

int serve(int argc, const char* const* argv) {
  return run_guarded("meshrepair", [&] {
    install_signal_handlers();
    install_signal_handler(SIGQUIT);  // its folder would stay
    set_up_logging("meshrepair", Verbosity::normal);
    CommandLine app("Serves a local web page that checks and repairs meshes with this program.",
                    "meshrepair --serve");
    ServeOptions options;
    add_options(app, options);
    try {
      if (!parse(app, argc, argv)) return ExitCode::done;
      return serve_until_signal(options);
    } catch (const UsageError& error) {  // the help of --serve says more, not that of the program
      throw ValueError(std::string(error.what()) + " (try 'meshrepair --serve --help')");
    }
  });
}

}  // namespace meshrepair
