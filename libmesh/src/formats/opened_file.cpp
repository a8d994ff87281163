// SPDX-License-Identifier: MIT
#include "opened_file.h"

#include <algorithm>
#include <utility>

#include <mesh/named_files.h>
#include <mesh/packing.h>

#include "formats/threemf/threemf_io.h"

namespace meshrepair {
namespace {

// Of the time that reading a packed file takes.
constexpr double kShareOfUnpacking = 0.3;

std::string_view without_byte_order_mark(std::string_view bytes) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return bytes.starts_with(kMark) ? bytes.substr(kMark.size()) : bytes;
}

// A 3MF file is an archive, but no packed mesh.
Packing packing_around_mesh(std::string_view bytes) {
  const Packing packing = packing_of_content(bytes);
  return packing == Packing::zip && is_threemf(bytes) ? Packing::none : packing;
}

MeshSource source_of_path(const std::filesystem::path& path, const ReadOptions& options) {
  if (path == "-") return {{}, "standard input", options};
  MeshSource source{{}, path.string(), options, path.parent_path()};
  if (!options.within.empty()) {
    source.levels_up = levels_below(options.within, path.parent_path());
  }
  return source;
}

}  // namespace

OpenedFile::OpenedFile(const std::filesystem::path& path, const ReadOptions& options)
    : source_(source_of_path(path, options)) {
  file_.emplace(path, options.progress);
  open(file_->bytes());
}

OpenedFile::OpenedFile(std::string_view bytes, const std::string& name, const ReadOptions& options)
    : source_{{}, name, options} {
  open(bytes);
}

NamesInFile OpenedFile::names() const {
  NamesInFile names = names_;
  for (std::vector<std::string>* list : {&names.files, &names.pictures, &names.outside}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  return names;
}

void OpenedFile::open(std::string_view bytes) {
  source_.names = &names_;
  const Packing packing = packing_around_mesh(bytes);
  if (packing != Packing::none) {
    take_out_of(bytes, packing);
    bytes = {unpacked_.begin(), unpacked_.size()};
  }
  size_ = bytes.size();
  source_.bytes = without_byte_order_mark(bytes);
  if (source_.bytes.empty()) source_.fail("is empty");
  if (packing != Packing::none) refuse_second_packing(packing);
}

void OpenedFile::take_out_of(std::string_view bytes, Packing packing) {
  packed_ = {packing, bytes.size(), {}};
  ProgressObserver* const progress = source_.options.progress;
  unpacking_.emplace(progress, 0, kShareOfUnpacking);
  reading_.emplace(progress, kShareOfUnpacking, 1);
  source_.packed_bytes = bytes.size();
  MeshSource packed = source_;
  packed.bytes = bytes;
  packed.packed_bytes = 0;
  packed.options.progress = &*unpacking_;
  if (packing == Packing::zip) {
    archive_.emplace(packed);
    unpacked_ = archive_->unpack_mesh();
    packed_.entry = archive_->entry();
    source_.name += ": " + packed_.entry;
    source_.folder = std::nullopt;
    source_.beside = &*archive_;
  } else {
    unpacked_ = unpack(packed, packing, warnings_);
    file_.reset();
  }
  source_.options.progress = &*reading_;
}

void OpenedFile::refuse_second_packing(Packing packing) const {
  const Packing second = packing_around_mesh(source_.bytes);
  if (second == Packing::none) return;
  std::string what = "is packed twice, by " + std::string(packing_name(second));
  what += " within " + std::string(packing_name(packing)) + ": unpack it first";
  source_.fail(what);
}

}  // namespace meshrepair
