// SPDX-License-Identifier: MIT
#include "resume/state_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <istream>
#include <ostream>
#include <streambuf>
#include <string>
#include <system_error>
#include <vector>
#include <zlib.h>

#include <base/internal/system.h>

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

struct Header {
  std::array<char, 16> magic = {'m', 'e', 's', 'h', 'r', 'e', 'p', 'a',
                                'i', 'r', ' ', 's', 't', 'a', 't', 'e'};
  std::uint64_t key = 0;
};

// Behind the bytes.
using Checksum = std::uint64_t;

constexpr std::size_t kStateBlock = std::size_t{1} << 16;
constexpr std::size_t kMostOfCall = std::size_t{1} << 24;  // what one call of the system is to take

Checksum continued(Checksum sum, const char* bytes, std::size_t size) {
  return ::crc32_z(static_cast<uLong>(sum), reinterpret_cast<const Bytef*>(bytes), size);
}

// Small pieces go through a block, large ones directly.
class ChecksumWriter : public std::streambuf {
 public:
  explicit ChecksumWriter(int file) : file_(file), block_(kStateBlock) { start_block(); }

  // All that was written, on the disk. Returns the error, or 0.
  int finish() {
    flush_block();
    write(reinterpret_cast<const char*>(&sum_), sizeof sum_);
    if (error_ == 0 && !internal::flush_to_disk(file_)) error_ = errno;
    return error_;
  }

 protected:
  int_type overflow(int_type next) override {
    flush_block();
    if (error_ != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(next, traits_type::eof())) {
      sputc(traits_type::to_char_type(next));
    }
    return traits_type::not_eof(next);
  }

  std::streamsize xsputn(const char* bytes, std::streamsize size) override {
    const auto count = static_cast<std::size_t>(size);
    if (count == 0) return 0;  // of an empty list, which may be nowhere
    if (size <= epptr() - pptr()) {
      std::memcpy(pptr(), bytes, count);
      pbump(static_cast<int>(size));
      return size;
    }
    flush_block();
    if (count < kStateBlock) return xsputn(bytes, size);
    put(bytes, count);
    return error_ == 0 ? size : 0;
  }

 private:
  void start_block() { setp(block_.data(), block_.data() + block_.size()); }

  void flush_block() {
    put(pbase(), static_cast<std::size_t>(pptr() - pbase()));
    start_block();
  }

  void put(const char* bytes, std::size_t size) {
    sum_ = continued(sum_, bytes, size);
    write(bytes, size);
  }

  void write(const char* bytes, std::size_t size) {
    while (size > 0 && error_ == 0) {
      const std::ptrdiff_t count = internal::write_some(file_, bytes, std::min(size, kMostOfCall));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) error_ = errno;
      if (count <= 0) return;
      bytes += count;
      size -= static_cast<std::size_t>(count);
    }
  }

  int file_;
  std::vector<char> block_;
  Checksum sum_ = 0;
  int error_ = 0;
};

// As many bytes as are left of a state.
class ChecksumReader : public std::streambuf {
 public:
  ChecksumReader(int file, std::uint64_t bytes) : file_(file), left_(bytes), block_(kStateBlock) {}

  // Reads what is left. Whether the checksum behind it is right.
  bool finish() {
    while (underflow() != traits_type::eof()) setg(nullptr, nullptr, nullptr);
    Checksum written = 0;
    const bool is_there = read(reinterpret_cast<char*>(&written), sizeof written) == sizeof written;
    return is_there && left_ == 0 && written == sum_;
  }

 protected:
  int_type underflow() override {
    if (gptr() < egptr()) return traits_type::to_int_type(*gptr());
    const std::size_t count = take(block_.data(), block_.size());
    setg(block_.data(), block_.data(), block_.data() + count);
    return count == 0 ? traits_type::eof() : traits_type::to_int_type(*gptr());
  }

  std::streamsize xsgetn(char* bytes, std::streamsize size) override {
    const std::streamsize there = std::min<std::streamsize>(size, egptr() - gptr());
    if (there > 0) std::memcpy(bytes, gptr(), static_cast<std::size_t>(there));
    gbump(static_cast<int>(there));
    const auto rest = static_cast<std::size_t>(size - there);
    if (rest >= kStateBlock) return there + static_cast<std::streamsize>(take(bytes + there, rest));
    if (rest == 0 || underflow() == traits_type::eof()) return there;
    return there + xsgetn(bytes + there, size - there);
  }

 private:
  std::size_t take(char* bytes, std::size_t most) {
    const auto at_most = static_cast<std::size_t>(std::min<std::uint64_t>(most, left_));
    const std::size_t count = read(bytes, at_most);
    sum_ = continued(sum_, bytes, count);
    left_ -= count;
    return count;
  }

  [[nodiscard]] std::size_t read(char* bytes, std::size_t size) const {
    std::size_t done = 0;
    while (done < size) {
      const std::ptrdiff_t count =
          internal::read_some(file_, bytes + done, std::min(size - done, kMostOfCall));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) break;
      done += static_cast<std::size_t>(count);
    }
    return done;
  }

  int file_;
  std::uint64_t left_;
  std::vector<char> block_;
  Checksum sum_ = 0;
};

// Closed with it.
struct Descriptor {
  explicit Descriptor(int descriptor) : number(descriptor) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number >= 0) internal::close_file(number);
  }

  const int number;
};

std::optional<Header> read_header(int file) {
  Header header;
  if (internal::read_some(file, reinterpret_cast<char*>(&header), sizeof header) != sizeof header) {
    return std::nullopt;
  }
  if (header.magic != Header().magic) return std::nullopt;
  return header;
}

[[noreturn]] void fail_writing(const fs::path& file, int error) {
  throw fs::filesystem_error("cannot be written", file, {error, std::generic_category()});
}

}  // namespace

std::optional<std::uint64_t> key_of_state(const fs::path& file) {
  const Descriptor in(internal::open_file(file, internal::FileUse::read));
  const auto header = in.number < 0 ? std::nullopt : read_header(in.number);
  return header ? std::optional(header->key) : std::nullopt;
}

void write_state(const fs::path& file, std::uint64_t key,
                 const std::function<void(std::ostream&)>& write) {
  const Descriptor to(internal::open_file(file, internal::FileUse::own));
  if (to.number < 0) fail_writing(file, errno);
  Header header;
  header.key = key;
  if (internal::write_some(to.number, reinterpret_cast<const char*>(&header), sizeof header) !=
      sizeof header) {
    fail_writing(file, errno);
  }
  ChecksumWriter writer(to.number);
  std::ostream out(&writer);
  write(out);
  const int error = writer.finish();
  if (error != 0) fail_writing(file, error);
}

bool read_state(const fs::path& file,
                const std::function<void(std::istream&, std::uint64_t)>& read) {
  std::error_code failed;
  const std::uint64_t size = fs::file_size(file, failed);
  const Descriptor from(internal::open_file(file, internal::FileUse::read));
  if (failed || from.number < 0 || size < sizeof(Header) + sizeof(Checksum)) return false;
  if (!read_header(from.number)) return false;
  const std::uint64_t bytes = size - sizeof(Header) - sizeof(Checksum);
  ChecksumReader reader(from.number, bytes);
  std::istream in(&reader);
  read(in, bytes);
  return reader.finish();
}

}  // namespace meshrepair
