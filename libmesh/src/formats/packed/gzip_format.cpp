// SPDX-License-Identifier: MIT
#include "gzip_format.h"

#include <algorithm>
#include <new>
#include <zlib.h>

#include <base/error.h>

namespace meshrepair {
namespace {

constexpr int kGzipWindow = 15 + 16;  // zlib's way to ask for gzip's header and checksum

// zlib counts in 32 bits.
constexpr std::size_t kMostInput = std::size_t{1} << 20;

// What is left of the input, in pieces.
void feed(z_stream& stream, std::string_view& rest) {
  if (stream.avail_in > 0 || rest.empty()) return;
  const std::size_t size = std::min(rest.size(), kMostInput);
  // zlib does not write there, but says so only where ZLIB_CONST is defined.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest.data()));
  stream.avail_in = static_cast<uInt>(size);
  rest.remove_prefix(size);
}

class Inflater {
 public:
  Inflater(const MeshSource& source, UnpackTarget& target)
      : source_(source), target_(target), rest_(source.bytes) {
    if (inflateInit2(&stream_, kGzipWindow) != Z_OK) throw std::bad_alloc();
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream_); }

  std::string_view run() {
    while (true) {
      const int status = step();
      if (status == Z_STREAM_END) {
        if (!begins_with_gzip(left())) return left();
        inflateReset(&stream_);
      } else if (status != Z_OK && status != Z_BUF_ERROR) {
        fail(status);
      } else if (left().empty() && stream_.avail_out > 0) {
        source_.fail("is cut off: what gzip packed has no end");
      }
    }
  }

 private:
  int step() {
    feed(stream_, rest_);
    const std::span<char> room = target_.room();
    stream_.next_out = reinterpret_cast<Bytef*>(room.data());
    stream_.avail_out = static_cast<uInt>(room.size());
    const int status = inflate(&stream_, Z_NO_FLUSH);
    target_.filled(room.size() - stream_.avail_out, left().size());
    return status;
  }

  [[nodiscard]] std::string_view left() const {
    return source_.bytes.substr(source_.bytes.size() - rest_.size() - stream_.avail_in);
  }

  [[noreturn]] void fail(int status) const {
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    const std::string reason = stream_.msg == nullptr ? "" : stream_.msg;
    if (reason == "incorrect data check" || reason == "incorrect length check") {
      source_.fail("is damaged: wrong gzip checksum");
    }
    source_.fail("is damaged, gzip cannot unpack it" + (reason.empty() ? "" : ": " + reason));
  }

  const MeshSource& source_;
  UnpackTarget& target_;
  std::string_view rest_;  // not yet given to zlib
  z_stream stream_ = {};
};

// Ends what zlib has begun. The header names the same system everywhere.
class Deflater {
 public:
  Deflater() {
    constexpr int kMemoryLevel = 8;  // the usual one
    if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzipWindow, kMemoryLevel,
                     Z_DEFAULT_STRATEGY) != Z_OK) {
      throw std::bad_alloc();
    }
    constexpr int kUnix = 3;
    header_.os = kUnix;
    deflateSetHeader(&stream, &header_);
  }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;
  ~Deflater() { deflateEnd(&stream); }

  z_stream stream = {};

 private:
  gz_header header_ = {};
};

}  // namespace

bool begins_with_gzip(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("\x1F\x8B\x08"sv);
}

std::string_view unpack_gzip(const MeshSource& source, UnpackTarget& target) {
  return Inflater(source, target).run();
}

std::string pack_gzip(std::string_view bytes, ProgressObserver* progress) {
  constexpr std::size_t kRoom = std::size_t{256} << 10;
  Deflater deflater;
  z_stream& stream = deflater.stream;
  std::string packed;
  for (int status = Z_OK; status != Z_STREAM_END;) {
    if (progress != nullptr && progress->cancelled()) throw Cancelled();
    feed(stream, bytes);
    const std::size_t before = packed.size();
    packed.resize(before + kRoom);
    stream.next_out = reinterpret_cast<Bytef*>(packed.data() + before);
    stream.avail_out = static_cast<uInt>(kRoom);
    status = deflate(&stream, bytes.empty() ? Z_FINISH : Z_NO_FLUSH);
    packed.resize(before + kRoom - stream.avail_out);
  }
  return packed;
}

}  // namespace meshrepair
