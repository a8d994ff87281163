// SPDX-License-Identifier: MIT
// The bytes of an input file together with the name that messages use, and the words of messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <base/warning.h>
#include <mesh/reading.h>

namespace meshrepair {

// The files that lie beside a mesh in the archive that it came out of.
class FilesBeside {
 public:
  FilesBeside() = default;
  FilesBeside(const FilesBeside&) = delete;
  FilesBeside& operator=(const FilesBeside&) = delete;
  virtual ~FilesBeside() = default;

  // All of the file that has this name as seen from the mesh, with '/' between folders; null if
  // there is none. Throws InputError when it cannot be unpacked.
  [[nodiscard]] virtual std::shared_ptr<const std::string> bytes_of(std::string_view name) = 0;
};

struct MeshSource {
  std::string_view bytes;
  std::string name;
  ReadOptions options = {};
  // Of the file, where what it names may be looked for: see named_files.h. Nothing if it came
  // from elsewhere.
  std::optional<std::filesystem::path> folder = std::nullopt;
  // Null unless it came out of an archive; not owned.
  FilesBeside* beside = nullptr;
  // How many folders up from there a name may lead.
  std::size_t levels_up = 0;
  // Gets the names that were looked for there, or not, if it is not null; not owned.
  NamesInFile* names = nullptr;
  // Of the file that the bytes were unpacked from; 0: they are those of the file.
  std::size_t packed_bytes = 0;

  // 1-based number of the line that holds the byte at `position`; LF, CRLF and CR end lines.
  // Linear.
  [[nodiscard]] std::size_t line_at(std::size_t position) const;

  // Throw InputError "NAME: what" and "NAME:LINE: what".
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_at(std::size_t position, const std::string& what) const;
};

// Where a text first holds a face or a point that is no such thing.
struct FirstBad {
  std::size_t face = 0;
  std::size_t point = 0;
};

// Puts the report's bad faces, of which `why` says what is wrong, and points into its warnings.
void warn_of_bad(ReadReport& report, const MeshSource& source, const FirstBad& first,
                 std::string_view face, std::string_view why, std::string_view point = "point");

// Of who promises more, or fewer, things than are there.
[[nodiscard]] Warning cut_off(std::string_view who, std::uint64_t promised, std::string_view noun,
                              std::uint64_t found);

// `where`: "after the last face".
[[nodiscard]] Warning bytes_ignored(std::size_t count, std::string_view where);

// How many of what a header promises there is room for.
[[nodiscard]] inline std::size_t within(std::uint64_t promised, std::size_t room) {
  return promised < room ? static_cast<std::size_t>(promised) : room;
}

// "1 face", "2 faces".
[[nodiscard]] std::string counted(std::uint64_t count, std::string_view noun);

// A word of the file for a message: a broken file's words may be long, or no text at all.
[[nodiscard]] std::string printable(std::string_view word);

}  // namespace meshrepair
