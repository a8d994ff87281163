// SPDX-License-Identifier: MIT
// Writing a file so that it is there in full or not at all.
#pragma once

#include <filesystem>
#include <string_view>

#include <base/progress.h>

namespace meshrepair {

// Writes `bytes` to a temporary file in the folder of `path`, flushes it to the disk and renames it
// to `path`, keeping the permissions of a file that was there. Devices, pipes and "-" (standard
// output) are written directly. Throws OutputError, naming the path and the system's reason; the
// temporary file is removed then and `path` is as it was. The same holds when `progress` cancels,
// which is asked several times a second, also while nobody reads the other end of a pipe.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes,
                           ProgressObserver* progress = nullptr);

// Where a chain of symbolic links ends, whether there is something or not; `path` itself if it is
// no link.
[[nodiscard]] std::filesystem::path follow_links(const std::filesystem::path& path);

// Removes the temporary file that is being written, if any. Safe to call from a signal handler.
void remove_unfinished_file() noexcept;

}  // namespace meshrepair
