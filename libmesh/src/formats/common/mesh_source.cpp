// SPDX-License-Identifier: MIT
#include <algorithm>

#include <base/error.h>
#include <mesh/mesh_source.h>

namespace meshrepair {

std::size_t MeshSource::line_at(std::size_t position) const {
  const std::string_view before = bytes.substr(0, std::min(position, bytes.size()));
  std::size_t line = 1;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool cr_of_crlf = before[i] == '\r' && i + 1 < bytes.size() && bytes[i + 1] == '\n';
    if (before[i] == '\n' || (before[i] == '\r' && !cr_of_crlf)) ++line;
  }
  return line;
}

void MeshSource::fail(const std::string& what) const { throw InputError(name + ": " + what); }

void MeshSource::fail_at(std::size_t position, const std::string& what) const {
  throw InputError(name + ":" + std::to_string(line_at(position)) + ": " + what);
}

void warn_of_bad(ReadReport& report, const MeshSource& source, const FirstBad& first,
                 std::string_view face, std::string_view why, std::string_view point) {
  const auto line_of = [&](std::size_t position) {
    return " (first: line " + std::to_string(source.line_at(position)) + ")";
  };
  if (report.bad_faces > 0) {
    report.warnings.push_back(
        {WarningCode::faces_unreadable,
         counted(report.bad_faces, face) + " left out: " + std::string(why) + line_of(first.face),
         {{"faces", report.bad_faces}}});
  }
  if (report.bad_points > 0) {
    report.warnings.push_back({WarningCode::points_unreadable,
                               "coordinates of " + counted(report.bad_points, point) +
                                   " are missing or not numbers" + line_of(first.point),
                               {{"points", report.bad_points}}});
  }
}

Warning cut_off(std::string_view who, std::uint64_t promised, std::string_view noun,
                std::uint64_t found) {
  return {WarningCode::file_cut_off,
          std::string(who) + " promises " + counted(promised, noun) + ", the file holds " +
              std::to_string(found),
          {{"promised", promised}, {"found", found}}};
}

Warning bytes_ignored(std::size_t count, std::string_view where) {
  return {WarningCode::bytes_ignored,
          counted(count, "byte") + " " + std::string(where) + " ignored",
          {{"bytes", count}}};
}

std::string counted(std::uint64_t count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

std::string printable(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text(word.substr(0, kLongest));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return word.size() > kLongest ? text + "..." : text;
}

}  // namespace meshrepair
