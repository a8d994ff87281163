// SPDX-License-Identifier: MIT
// What only the operating system can tell or do. libbase/src/system has a source for each system,
// which alone includes its headers; what one of them cannot do says so by its result. Descriptors
// are those of the C library, errors are in errno.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <thread>

namespace meshrepair::internal {

constexpr int kStandardInput = 0, kStandardOutput = 1, kStandardError = 2;

// Files. Bytes are read and written as they are; a file that is open is not passed on to processes
// that are started.
enum class FileUse {
  read,
  read_at_once,  // a pipe that nobody writes into is not waited for
  write,         // a file, pipe or device that is there
  create,        // there must be none
  own,           // from its start, and none of others' business
};
// -1: it cannot be opened.
[[nodiscard]] int open_file(const std::filesystem::path& path, FileUse use) noexcept;
// -1: an error; 0: the end.
[[nodiscard]] std::ptrdiff_t read_some(int descriptor, char* bytes, std::size_t most) noexcept;
[[nodiscard]] std::ptrdiff_t write_some(int descriptor, const char* bytes,
                                        std::size_t most) noexcept;
// False: an error, such as a disk that is full.
bool close_file(int descriptor) noexcept;

enum class FileKind { none, regular, folder, other };
struct FileFacts {
  FileKind kind = FileKind::none;
  std::uint64_t bytes = 0;  // of a regular file
};
[[nodiscard]] FileFacts facts_of_file(int descriptor) noexcept;
[[nodiscard]] FileFacts facts_of_file(const std::filesystem::path& path) noexcept;

// Whether a read or write would not wait. Waits for that as long as a question takes a person to
// notice. True where the system cannot tell.
enum class Direction { in, out };
[[nodiscard]] bool is_ready(int descriptor, Direction direction) noexcept;
// Of a pipe that is ready.
[[nodiscard]] std::size_t most_without_waiting(int descriptor) noexcept;

[[nodiscard]] bool may_write(const std::filesystem::path& path) noexcept;
// What it may keep of the owner, and the permissions, of a file that is there.
[[nodiscard]] bool take_permissions(int descriptor, const std::filesystem::path& of) noexcept;
[[nodiscard]] bool flush_to_disk(int descriptor) noexcept;
// In place of a file that may be there.
[[nodiscard]] bool rename_file(const std::filesystem::path& from,
                               const std::filesystem::path& to) noexcept;
// Makes a rename in it last through a power failure, where the file system can.
void flush_folder(const std::filesystem::path& folder) noexcept;
// A folder that one process at a time has. It is made, for this user alone, if it is not there.
// Gives what release_folder() takes; -1: it is none, or, where errno is EWOULDBLOCK, another
// process has it.
[[nodiscard]] int hold_folder(const std::filesystem::path& folder) noexcept;
// Removes it if it is empty.
void release_folder(const std::filesystem::path& folder, int held) noexcept;
// From a signal handler, too.
void remove_file_now(const std::filesystem::path::value_type* name) noexcept;
// A name longer than this is none.
[[nodiscard]] std::size_t longest_path() noexcept;
// Nothing: the system has none.
[[nodiscard]] std::optional<std::uint64_t> random_bits() noexcept;

// This process.
[[nodiscard]] double cpu_seconds() noexcept;
[[nodiscard]] std::size_t peak_memory() noexcept;  // bytes
struct ProcessMemory {                             // in bytes; 0 where the system does not tell
  std::uint64_t resident = 0;
  std::uint64_t own = 0;       // the part of it that is no file's
  std::uint64_t reserved = 0;  // of its own, in use or not
};
// Asked often, by several threads, and by a handler of signals.
[[nodiscard]] ProcessMemory process_memory() noexcept;
// What can be taken without swapping: of the machine, or of the group of processes that this one
// lives in. Nothing: the system does not tell.
[[nodiscard]] std::optional<std::uint64_t> free_memory();
// Makes the system, where it can, refuse more than this to the process, so that it meets
// std::bad_alloc in place of the system's killer; the stacks of so many threads that are yet to
// start do not count. Gives what the program needs for itself where that is more, else 0.
[[nodiscard]] std::uint64_t limit_process_memory(std::uint64_t bytes, std::size_t threads);
// Without destructors, streams and what runs at the end. From a signal handler, too.
[[noreturn]] void end_process_now(int code) noexcept;
// A path to the file of the program. Empty: the system does not tell.
[[nodiscard]] std::filesystem::path program_file();
[[nodiscard]] bool is_open(int descriptor) noexcept;

// Requests to end come from the terminal and from who administers the system, with the numbers of
// POSIX. `handle` is a signal handler. What was ignored when the program started (nohup) stays
// ignored.
constexpr int kHangUp = 1, kInterrupt = 2, kQuit = 3, kTerminate = 15;
void handle_request_to_end(int number, void (*handle)(int number)) noexcept;
// Where no handler can be called, the number of the request that was made; 0: none.
[[nodiscard]] int request_to_end_without_handler() noexcept;
// Bytes pass standard streams as they are. Pipes that nobody reads and limits on the size of files
// become errors of writing.
void prepare_standard_streams() noexcept;
// Signals are for other threads: those that wait for input and output are to wake up.
[[nodiscard]] std::thread thread_without_signals(std::function<void()> work);

// Terminals.
[[nodiscard]] bool is_terminal(int descriptor) noexcept;
[[nodiscard]] int terminal_columns(int descriptor) noexcept;  // 0: it does not tell

}  // namespace meshrepair::internal
