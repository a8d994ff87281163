// SPDX-License-Identifier: MIT
#include "zip_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <zip.h>

#include <base/byte_order.h>

#include "part_names.h"

namespace meshrepair {
namespace {

constexpr std::size_t kPiece = std::size_t{64} << 10;

// How many entries the archive's end promises, if it is one of 64 bits: memory is taken for all of
// them before the first is looked for.
std::optional<std::uint64_t> promised_entries(std::string_view bytes, std::size_t end_record) {
  using namespace std::string_view_literals;
  constexpr std::size_t kLocatorSize = 20, kRecordSize = 56;
  if (end_record < kLocatorSize) return std::nullopt;
  const std::string_view locator = bytes.substr(end_record - kLocatorSize, kLocatorSize);
  if (!locator.starts_with("PK\x06\x07"sv)) return std::nullopt;
  const auto record = load<std::uint64_t>(locator.data() + 8, std::endian::little);
  if (record > bytes.size() || bytes.size() - record < kRecordSize) return std::nullopt;
  return load<std::uint64_t>(bytes.data() + record + 32, std::endian::little);
}

bool promises_too_many(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr std::size_t kSmallestEntry = 46;
  for (std::size_t at = bytes.rfind("PK\x05\x06"sv); at != std::string_view::npos && at > 0;
       at = bytes.rfind("PK\x05\x06"sv, at - 1)) {
    const auto promised = promised_entries(bytes, at);
    if (promised && *promised > bytes.size() / kSmallestEntry) return true;
  }
  return false;
}

std::string reason_of(zip_error_t* error) {
  std::string reason = printable(zip_error_strerror(error));
  if (!reason.empty() && reason.size() > 1 && reason[1] >= 'a') {
    reason[0] =
        static_cast<char>(reason[0] >= 'A' && reason[0] <= 'Z' ? reason[0] - 'A' + 'a' : reason[0]);
  }
  return reason;
}

class ZipError {
 public:
  ZipError() { zip_error_init(&error_); }
  ~ZipError() { zip_error_fini(&error_); }
  ZipError(const ZipError&) = delete;
  ZipError& operator=(const ZipError&) = delete;
  zip_error_t* get() { return &error_; }

 private:
  zip_error_t error_;
};

struct CloseEntry {
  void operator()(zip_file_t* file) const { (void)zip_fclose(file); }
};

}  // namespace

void ZipReader::Discard::operator()(zip* archive) const { zip_discard(archive); }

ZipReader::ZipReader(const MeshSource& source)
    : source_(source),
      budget_(source.packed_bytes > 0 ? source.packed_bytes : source.bytes.size()) {
  if (promises_too_many(source.bytes)) {
    source.fail("is no usable ZIP archive: it promises more entries than it has room for");
  }
  ZipError error;
  zip_source_t* const buffer =
      zip_source_buffer_create(source.bytes.data(), source.bytes.size(), 0, error.get());
  if (buffer != nullptr) {
    archive_.reset(zip_open_from_source(buffer, ZIP_RDONLY, error.get()));
    if (!archive_) zip_source_free(buffer);
  }
  if (!archive_) source.fail("is no usable ZIP archive: " + reason_of(error.get()));
  const auto count =
      static_cast<std::uint64_t>(std::max<zip_int64_t>(zip_get_num_entries(archive_.get(), 0), 0));
  for (std::uint64_t number = 0; number < count; ++number) add_entry(number);
}

void ZipReader::add_entry(std::uint64_t number) {
  zip_stat_t stat;
  zip_stat_init(&stat);
  constexpr std::uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE;
  if (zip_stat_index(archive_.get(), number, 0, &stat) != 0 || (stat.valid & kNeeded) != kNeeded) {
    ++passed_over_;
    return;
  }
  Entry entry{stat.name, number, stat.size, stat.comp_size, false};
  std::replace(entry.name.begin(), entry.name.end(), '\\', '/');
  if (entry.name.ends_with('/')) return;  // a folder
  entry.encrypted =
      (stat.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 && stat.encryption_method != ZIP_EM_NONE;
  if (!is_part_name(entry.name) || !is_part_name(percent_decoded(entry.name)) ||
      !by_key_.try_emplace(part_key(entry.name), entries_.size()).second) {
    ++passed_over_;
    return;
  }
  entries_.push_back(std::move(entry));
}

const ZipReader::Entry* ZipReader::find(std::string_view name) const {
  const auto found = by_key_.find(part_key(name));
  return found == by_key_.end() ? nullptr : &entries_[found->second];
}

void ZipReader::read(const Entry& entry, const std::function<void(std::string_view)>& sink) {
  const auto fail = [&](const std::string& what) {
    source_.fail("its part " + printable(entry.name) + " " + what);
  };
  constexpr const char* kTooMuch = "unpacks to more than a file of this size should hold";
  if (entry.encrypted) fail("is encrypted");
  if (entry.size > budget_.left()) fail(kTooMuch);
  const std::unique_ptr<zip_file_t, CloseEntry> file(
      zip_fopen_index(archive_.get(), entry.number, 0));
  if (!file) fail("cannot be read: " + reason_of(zip_get_error(archive_.get())));
  std::array<char, kPiece> piece;
  std::uint64_t total = 0;
  while (true) {
    const zip_int64_t count = zip_fread(file.get(), piece.data(), piece.size());
    if (count < 0) fail("is damaged: " + reason_of(zip_file_get_error(file.get())));
    if (count == 0) break;
    const auto read = static_cast<std::uint64_t>(count);
    total += read;
    if (total > entry.size) fail("is larger than it says");
    if (!budget_.take(read)) fail(kTooMuch);
    sink(std::string_view(piece.data(), static_cast<std::size_t>(count)));
  }
  if (total != entry.size) fail("is smaller than it says");
}

std::string ZipReader::text_of(const Entry& entry) {
  std::string text;
  read(entry, [&](std::string_view piece) { text += piece; });
  return text;
}

}  // namespace meshrepair
