// SPDX-License-Identifier: MIT
// A ZIP archive that holds one mesh, and the files that the mesh names.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <base/trivial_vector.h>
#include <mesh/mesh_source.h>

#include "formats/common/zip_reader.h"

namespace meshrepair {

class MeshArchive final : public FilesBeside {
 public:
  // Its bytes have to stay. Throws InputError when it is no archive that can be read.
  explicit MeshArchive(const MeshSource& source) : source_(source), archive_(source_) {}

  // The one entry that is a mesh or points: by its extension or, where none has one that tells, by
  // its content. Throws InputError when there are none or several, or it cannot be unpacked;
  // Cancelled.
  [[nodiscard]] TrivialVector<char> unpack_mesh();
  // The name of that entry.
  [[nodiscard]] const std::string& entry() const { return entry_; }

  [[nodiscard]] std::shared_ptr<const std::string> bytes_of(std::string_view name) override;

 private:
  using Entries = std::vector<const ZipReader::Entry*>;

  [[nodiscard]] Entries named_as_meshes() const;
  [[nodiscard]] Entries with_content_of_meshes();
  // `progress` may be null.
  [[nodiscard]] TrivialVector<char> unpack_entry(const ZipReader::Entry& entry,
                                                 ProgressObserver* progress);

  MeshSource source_;
  CancelOnly cancel_only_{source_.options.progress};
  ZipReader archive_;
  std::string entry_;
  std::unordered_map<std::uint64_t, std::shared_ptr<const std::string>> read_;  // by number
};

}  // namespace meshrepair
