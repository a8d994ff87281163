// SPDX-License-Identifier: MIT
// A file that is to be read: its bytes, unpacked if they are packed, and where they come from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/file_bytes.h>
#include <base/progress.h>
#include <base/trivial_vector.h>
#include <mesh/far_coordinates.h>
#include <mesh/mesh_source.h>
#include <mesh/packing.h>

#include "mesh_archive.h"

namespace meshrepair {

class OpenedFile {
 public:
  // "-" is standard input. Throws InputError where the file cannot be opened, is empty, cannot be
  // unpacked, or is packed twice; Cancelled.
  OpenedFile(const std::filesystem::path& path, const ReadOptions& options);
  // Bytes that stay; `name` is used in messages and for its extension.
  OpenedFile(std::string_view bytes, const std::string& name, const ReadOptions& options);
  OpenedFile(const OpenedFile&) = delete;
  OpenedFile& operator=(const OpenedFile&) = delete;

  // As readers take it. Its observer sees what is left of the stage.
  [[nodiscard]] const MeshSource& source() const { return source_; }

  // Says in the report of a reader how large the file is, what it was packed in, and what was odd
  // about that.
  template <class Report>
  void describe(Report& report) const {
    report.bytes = size_;
    report.packed = packed_;
    report.offset = find_offset_comment(source_.bytes);
    report.warnings.insert(report.warnings.begin(), warnings_.begin(), warnings_.end());
  }
  // Of other files, that the reader came upon.
  [[nodiscard]] NamesInFile names() const;

 private:
  void open(std::string_view bytes);
  void take_out_of(std::string_view bytes, Packing packing);
  void refuse_second_packing(Packing packing) const;

  std::optional<FileBytes> file_;
  std::optional<ShareOfStage> unpacking_, reading_;
  std::optional<MeshArchive> archive_;
  TrivialVector<char> unpacked_;
  MeshSource source_;
  std::size_t size_ = 0;
  PackedFile packed_;
  std::vector<Warning> warnings_;
  NamesInFile names_;
};

}  // namespace meshrepair
