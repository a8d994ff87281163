#include <mesh/unpack.h>

#include "gzip_format.h"
#include "unpack_target.h"
#include "zstd_format.h"

namespace meshrepair {

TrivialVector<char> unpack(const MeshSource& source, Packing packing,
                           std::vector<std::string>& warnings) {
  UnpackTarget target(source);
  const std::string_view rest =
      packing == Packing::gzip ? unpack_gzip(source, target) : unpack_zstd(source, target);
  // Tapes and some programs fill up with zeros.
  if (rest.find_first_not_of('\0') != std::string_view::npos) {
    warnings.push_back(counted(rest.size(), "byte") + " behind what " +
                       std::string(packing_name(packing)) + " packed, left out");
  }
  return target.take();
}

}  // namespace meshrepair
