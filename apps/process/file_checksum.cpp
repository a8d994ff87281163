// SPDX-License-Identifier: MIT
#include "process/file_checksum.h"

#include <cstddef>
#include <fstream>
#include <ios>
#include <system_error>
#include <vector>
#include <zlib.h>

#include <base/error.h>
#include <base/internal/system.h>

namespace meshrepair {
namespace {

constexpr std::size_t kReadAtOnce = std::size_t{1} << 20;

}  // namespace

std::uint64_t file_checksum(const std::filesystem::path& file) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed)) {
    throw InputError(file.string() + ": is no file that can be read");
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file.string() + ": cannot be opened");
  std::vector<char> block(kReadAtOnce);
  std::uint64_t sum = 0, size = 0;
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    const auto count = static_cast<std::size_t>(in.gcount());
    sum = ::crc32_z(static_cast<uLong>(sum), reinterpret_cast<const Bytef*>(block.data()), count);
    size += count;
  }
  if (in.bad()) throw InputError(file.string() + ": cannot be read to its end");
  return size << 32 ^ sum;
}

std::uint64_t program_checksum() {
  const std::filesystem::path program = internal::program_file();
  if (program.empty()) throw ValueError("the system does not tell where this program is");
  return file_checksum(program);
}

}  // namespace meshrepair
