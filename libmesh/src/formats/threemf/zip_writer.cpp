// SPDX-License-Identifier: MIT
#include "zip_writer.h"

#include <zip.h>

#include <base/error.h>
#include <mesh/mesh_source.h>

namespace meshrepair {
namespace {

// 1980-01-01 12:00:00, as MS-DOS counts: no time zone moves it before the first day that it can be.
constexpr zip_uint16_t kDosTime = 12 << 11;
constexpr zip_uint16_t kDosDate = (1 << 5) | 1;

// Twice as fast as the usual level, for a tenth more bytes.
constexpr zip_uint32_t kDeflateLevel = 3;

[[noreturn]] void fail_to_pack(const char* reason) {
  throw OutputError("the ZIP archive cannot be made: " + printable(reason));
}

}  // namespace

void ZipWriter::FreeSource::operator()(zip_source* source) const { zip_source_free(source); }

void ZipWriter::DiscardArchive::operator()(zip* archive) const { zip_discard(archive); }

ZipWriter::ZipWriter() {
  zip_error_t error;
  zip_error_init(&error);
  target_.reset(zip_source_buffer_create(nullptr, 0, 0, &error));
  if (!target_) fail_to_pack("no memory");
  archive_.reset(zip_open_from_source(target_.get(), ZIP_TRUNCATE | ZIP_CREATE, &error));
  if (!archive_) fail_to_pack("no memory");
  zip_source_keep(target_.get());  // the archive has one hold on it, this object the other
  zip_error_fini(&error);
}

ZipWriter::~ZipWriter() = default;

void ZipWriter::add(const std::string& name, std::string_view bytes, bool is_packed) {
  zip* const archive = archive_.get();
  zip_source_t* const source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
  if (source == nullptr) fail_to_pack(zip_strerror(archive));
  const zip_int64_t added = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (added < 0) {
    zip_source_free(source);
    fail_to_pack(zip_strerror(archive));
  }
  const auto number = static_cast<zip_uint64_t>(added);
  const zip_int32_t method = is_packed ? ZIP_CM_STORE : ZIP_CM_DEFLATE;
  if (zip_set_file_compression(archive, number, method, is_packed ? 0 : kDeflateLevel) != 0 ||
      zip_file_set_dostime(archive, number, kDosTime, kDosDate, 0) != 0) {
    fail_to_pack(zip_strerror(archive));
  }
}

void ZipWriter::add_text(const std::string& name, std::string text) {
  texts_.push_back(std::move(text));
  add(name, texts_.back(), false);
}

std::string ZipWriter::finish() {
  if (zip_close(archive_.get()) != 0) fail_to_pack(zip_strerror(archive_.get()));
  (void)archive_.release();  // closed
  zip_source_t* const packed = target_.get();
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_source_open(packed) != 0 || zip_source_stat(packed, &stat) != 0) {
    fail_to_pack("it cannot be read back");
  }
  std::string bytes(static_cast<std::size_t>(stat.size), '\0');
  const zip_int64_t read = zip_source_read(packed, bytes.data(), bytes.size());
  (void)zip_source_close(packed);
  if (read < 0 || static_cast<zip_uint64_t>(read) != stat.size) {
    fail_to_pack("it cannot be read back");
  }
  return bytes;
}

}  // namespace meshrepair
