// SPDX-License-Identifier: MIT
#include "mesh_archive.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include <base/error.h>
#include <mesh/packing.h>
#include <mesh/recognize_format.h>
#include <mesh/soup_format.h>

#include "formats/common/part_names.h"
#include "formats/common/text_scanner.h"
#include "formats/off/off_io.h"
#include "formats/pcd/pcd_points.h"
#include "formats/xyz/xyz_points.h"

namespace meshrepair {
namespace {

// Extensions of points that are those of any text, too.
bool is_of_any_text(const std::string& extension) {
  constexpr std::array<std::string_view, 3> kTexts = {".txt", ".asc", ".csv"};
  return std::any_of(kTexts.begin(), kTexts.end(),
                     [&](std::string_view text) { return equals_ignoring_case(extension, text); });
}

bool is_named_as_mesh(const std::string& name) {
  if (format_of_extension(name)) return true;
  const std::string extension = without_packing(name).extension().string();
  if (equals_ignoring_case(extension, ".pcd")) return true;
  return has_point_extension(name) && !is_of_any_text(extension);
}

// What systems put into archives unasked, such as "__MACOSX/._part.stl".
bool is_hidden(const std::string& name) {
  return last_of_part(name).starts_with('.') || name.starts_with("__MACOSX/");
}

bool has_line_of_point(std::string_view text) {
  return text.starts_with("v ") || text.find("\nv ") != std::string_view::npos;
}

// One word at the start is enough for a file that somebody took for a mesh, but not for a note that
// lies in an archive.
bool has_content_of_mesh(std::string_view bytes) {
  if (begins_with_pcd(bytes) || begins_with_points(bytes)) return true;
  const auto format = recognize_content(bytes);
  if (format == SoupFormat::off) return begins_with_off(bytes);
  if (format == SoupFormat::obj) return has_line_of_point(bytes);
  if (format == SoupFormat::stl_ascii) return bytes.find("vertex") != std::string_view::npos;
  return format.has_value();
}

// The end of a name counts most.
std::string shown(std::string_view name) {
  constexpr std::size_t kLongest = 40;
  return name.size() <= kLongest ? printable(name)
                                 : "..." + printable(name.substr(name.size() - kLongest + 3));
}

std::string several(const std::vector<const ZipReader::Entry*>& entries) {
  constexpr std::size_t kMostShown = 4;
  std::string names;
  for (std::size_t i = 0; i < std::min(entries.size(), kMostShown); ++i) {
    names += (i == 0 ? "" : ", ") + shown(entries[i]->name);
  }
  if (entries.size() > kMostShown) {
    names += " and " + std::to_string(entries.size() - kMostShown) + " more";
  }
  return names;
}

}  // namespace

TrivialVector<char> MeshArchive::unpack_mesh() {
  Entries found = named_as_meshes();
  if (found.empty()) found = with_content_of_meshes();
  if (found.empty()) {
    source_.fail("is a ZIP archive that holds no mesh" +
                 (archive_.passed_over() == 0
                      ? std::string()
                      : "; passed over: " + counted(archive_.passed_over(), "file") +
                            " whose names lead out of it or stand there twice"));
  }
  if (found.size() > 1) {
    source_.fail("holds several meshes, and which one is meant is not clear: " + several(found));
  }
  entry_ = found.front()->name;
  return unpack_entry(*found.front(), source_.options.progress);
}

std::shared_ptr<const std::string> MeshArchive::bytes_of(std::string_view name) {
  const std::string path = part_name(name, entry_);
  const ZipReader::Entry* const entry = path.empty() ? nullptr : archive_.find(path);
  if (entry == nullptr) return nullptr;
  const auto [found, is_new] = read_.try_emplace(entry->number);
  if (is_new) {
    try {
      const TrivialVector<char> bytes = unpack_entry(*entry, &cancel_only_);
      found->second = std::make_shared<const std::string>(bytes.begin(), bytes.end());
    } catch (...) {
      read_.erase(found);
      throw;
    }
  }
  return found->second;
}

MeshArchive::Entries MeshArchive::named_as_meshes() const {
  Entries found;
  for (const ZipReader::Entry& entry : archive_.entries()) {
    if (!is_hidden(entry.name) && is_named_as_mesh(entry.name)) found.push_back(&entry);
  }
  return found;
}

MeshArchive::Entries MeshArchive::with_content_of_meshes() {
  Entries found;
  for (const ZipReader::Entry& entry : archive_.entries()) {
    if (is_hidden(entry.name)) continue;
    const TrivialVector<char> bytes = unpack_entry(entry, &cancel_only_);
    if (has_content_of_mesh({bytes.begin(), bytes.size()})) found.push_back(&entry);
  }
  return found;
}

TrivialVector<char> MeshArchive::unpack_entry(const ZipReader::Entry& entry,
                                              ProgressObserver* progress) {
  TrivialVector<char> bytes;
  archive_.read(entry, [&](std::string_view piece) {
    const std::size_t size = bytes.size();
    if (bytes.capacity() - size < piece.size()) {
      bytes.reserve(std::max(size + piece.size(), size + size / 2));
    }
    bytes.resize_for_overwrite(size + piece.size());
    std::copy(piece.begin(), piece.end(), bytes.data() + size);
    if (progress == nullptr) return;
    progress->advance(static_cast<double>(bytes.size()) / static_cast<double>(entry.size));
    if (progress->cancelled()) throw Cancelled();
  });
  return bytes;
}

}  // namespace meshrepair
