// SPDX-License-Identifier: MIT
// The reader of OpenMesh's own format takes a file: here one in memory.
#include <string>
#include <sys/mman.h>
#include <unistd.h>

#include <base/error.h>
#include <mesh/openmesh.h>

#include "check_reading.h"

namespace meshrepair::testing {
namespace {

class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : file_(::memfd_create("mesh.om", 0)) {
    require(file_ >= 0 && ::write(file_, data, size) == static_cast<ssize_t>(size), "no memory");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(file_); }

  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

// The half-edge mesh is the same mesh, where there is one.
void require_openmesh_round_trip(const TriangleSoup& soup) {
  TriMesh mesh;
  try {
    mesh = to_openmesh(soup);
  } catch (const InputError& error) {
    require_one_line(error.what());
    return;
  }
  TriangleSoup back = from_openmesh(mesh);
  for (std::size_t t = 0; t < back.triangles.size(); ++t) {
    // OpenMesh begins a face where it likes.
    auto& corners = back.triangles[t];
    std::rotate(corners.begin(), std::find(corners.begin(), corners.end(), soup.triangles[t][0]),
                corners.end());
  }
  require(same_soup(back, soup), "OpenMesh holds another mesh");
}

void check(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  TriangleSoup soup;
  try {
    soup = read_om(file.path());
  } catch (const InputError& error) {
    require_one_line(error.what());
    return;
  }
  require_valid_indices(soup);
  require(!soup.triangles.empty(), "a soup without triangles was not refused");
  require_round_trips(soup);
  require_openmesh_round_trip(soup);
}

}  // namespace
}  // namespace meshrepair::testing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  meshrepair::testing::check(data, size);
  return 0;
}
