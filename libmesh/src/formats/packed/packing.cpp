// SPDX-License-Identifier: MIT
#include <array>
#include <utility>

#include <mesh/mesh_source.h>
#include <mesh/packing.h>

#include "formats/common/text_scanner.h"
#include "gzip_format.h"
#include "unpack_target.h"
#include "zstd_format.h"

namespace meshrepair {
namespace {

// An archive without files has the end of its directory alone.
bool begins_with_zip_record(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("PK\x03\x04"sv) || bytes.starts_with("PK\x05\x06"sv);
}

}  // namespace

std::string_view packing_name(Packing packing) {
  constexpr std::array<std::string_view, 4> kNames = {"", "gzip", "zstd", "ZIP"};
  return kNames[static_cast<std::size_t>(packing)];
}

Packing packing_of_content(std::string_view bytes) {
  if (begins_with_gzip(bytes)) return Packing::gzip;
  if (begins_with_zstd(bytes)) return Packing::zstd;
  return begins_with_zip_record(bytes) ? Packing::zip : Packing::none;
}

Packing packing_of_extension(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (equals_ignoring_case(extension, ".gz")) return Packing::gzip;
  return equals_ignoring_case(extension, ".zst") ? Packing::zstd : Packing::none;
}

std::filesystem::path without_packing(const std::filesystem::path& path) {
  if (packing_of_extension(path) == Packing::none) return path;
  return path.parent_path() / path.stem();
}

std::string pack_bytes(std::string_view bytes, Packing packing, ProgressObserver* progress) {
  switch (packing) {
    case Packing::gzip:
      return pack_gzip(bytes, progress);
    case Packing::zstd:
      return pack_zstd(bytes, progress);
    case Packing::none:
    case Packing::zip:
      break;
  }
  return std::string(bytes);
}

TrivialVector<char> unpack(const MeshSource& source, Packing packing,
                           std::vector<Warning>& warnings) {
  UnpackTarget target(source);
  const std::string_view rest =
      packing == Packing::gzip ? unpack_gzip(source, target) : unpack_zstd(source, target);
  // Tapes and some programs fill up with zeros.
  if (rest.find_first_not_of('\0') != std::string_view::npos) {
    warnings.push_back({WarningCode::bytes_ignored,
                        counted(rest.size(), "byte") + " behind what " +
                            std::string(packing_name(packing)) + " packed, left out",
                        {{"bytes", rest.size()}}});
  }
  return target.take();
}

}  // namespace meshrepair
