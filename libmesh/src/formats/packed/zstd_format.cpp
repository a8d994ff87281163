// SPDX-License-Identifier: MIT
#include "zstd_format.h"

#include <memory>
#include <new>
#include <zstd.h>
#include <zstd_errors.h>

#include <base/error.h>

namespace meshrepair {
namespace {

// How far back a frame may reach, as the power of two: as far as the program zstd allows, and in
// files that may hold so much, as far as there is.
int largest_window(const UnpackBudget& budget) {
  constexpr int kAlways = 27, kMost = 31;
  int log = kAlways;
  while (log < kMost && budget.left() >> (log + 1) > 0) ++log;
  return log;
}

struct FreeDecoder {
  void operator()(ZSTD_DCtx* decoder) const { ZSTD_freeDCtx(decoder); }
};

struct FreeEncoder {
  void operator()(ZSTD_CCtx* encoder) const { ZSTD_freeCCtx(encoder); }
};

[[noreturn]] void fail_to_unpack(const MeshSource& source, std::size_t error) {
  switch (ZSTD_getErrorCode(error)) {
    case ZSTD_error_memory_allocation:
      throw std::bad_alloc();
    case ZSTD_error_checksum_wrong:
      source.fail("is damaged: wrong zstd checksum");
    case ZSTD_error_dictionary_wrong:
      source.fail("is packed by zstd with a dictionary, which is not here");
    case ZSTD_error_frameParameter_windowTooLarge:
      source.fail("is packed by zstd with a window that is too large for a file of this size");
    default:
      source.fail("is damaged, zstd cannot unpack it: " + std::string(ZSTD_getErrorName(error)));
  }
}

std::size_t checked_size(std::size_t result) {
  if (ZSTD_isError(result) == 0) return result;
  if (ZSTD_getErrorCode(result) == ZSTD_error_memory_allocation) throw std::bad_alloc();
  throw InternalError(std::string("zstd: ") + ZSTD_getErrorName(result));
}

}  // namespace

bool begins_with_zstd(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\x28\xB5\x2F\xFD"sv)) return true;
  return bytes.size() >= 4 && (static_cast<unsigned char>(bytes[0]) & 0xF0) == 0x50 &&
         bytes.substr(1).starts_with("\x2A\x4D\x18"sv);
}

std::string_view unpack_zstd(const MeshSource& source, UnpackTarget& target) {
  const std::unique_ptr<ZSTD_DCtx, FreeDecoder> decoder(ZSTD_createDCtx());
  if (!decoder) throw std::bad_alloc();
  checked_size(
      ZSTD_DCtx_setParameter(decoder.get(), ZSTD_d_windowLogMax, largest_window(target.budget())));
  ZSTD_inBuffer in = {source.bytes.data(), source.bytes.size(), 0};
  while (true) {
    const std::span<char> room = target.room();
    ZSTD_outBuffer out = {room.data(), room.size(), 0};
    const std::size_t wanted = ZSTD_decompressStream(decoder.get(), &out, &in);
    if (ZSTD_isError(wanted) != 0) fail_to_unpack(source, wanted);
    target.filled(out.pos, in.size - in.pos);
    const std::string_view left = source.bytes.substr(in.pos);
    if (wanted == 0 && !begins_with_zstd(left)) return left;
    if (wanted > 0 && left.empty() && out.pos < out.size) {
      source.fail("is cut off: what zstd packed has no end");
    }
  }
}

std::string pack_zstd(std::string_view bytes, ProgressObserver* progress) {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  const std::unique_ptr<ZSTD_CCtx, FreeEncoder> encoder(ZSTD_createCCtx());
  if (!encoder) throw std::bad_alloc();
  checked_size(ZSTD_CCtx_setParameter(encoder.get(), ZSTD_c_checksumFlag, 1));
  checked_size(ZSTD_CCtx_setPledgedSrcSize(encoder.get(), bytes.size()));
  std::string packed;
  ZSTD_inBuffer in = {bytes.data(), 0, 0};
  for (std::size_t left = 1; left > 0;) {
    if (progress != nullptr && progress->cancelled()) throw Cancelled();
    if (in.pos == in.size) in.size = std::min(bytes.size(), in.size + kPiece);
    const bool is_last = in.size == bytes.size();
    const std::size_t before = packed.size();
    packed.resize(before + ZSTD_CStreamOutSize());
    ZSTD_outBuffer out = {packed.data() + before, packed.size() - before, 0};
    left = checked_size(
        ZSTD_compressStream2(encoder.get(), &out, &in, is_last ? ZSTD_e_end : ZSTD_e_continue));
    packed.resize(before + out.pos);
    if (!is_last) left = 1;
  }
  return packed;
}

}  // namespace meshrepair
