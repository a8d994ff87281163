// Says what an input of fuzz_repair asks for, and writes its soup to a file: for a look at a
// finding with other programs.
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>

#include <mesh/soup_io.h>

#include "repair_request.h"

namespace meshrepair::testing {
namespace {

constexpr const char* kUsage =
    "Usage: show_repair_input INPUT MESH\n\n"
    "Prints the options of meshrepair that an input of fuzz_repair stands for, and writes its "
    "soup\n"
    "to MESH (OBJ, OFF or PLY).\n";

void show(const RepairRequest& request) {
  const RepairOptions& o = request.options;
  std::string line = "--inside " + std::string(rule_name(o.inside.rule));
  line += " --holes " + std::string(hole_mode_name(o.holes.mode));
  if (o.inside.cavities == Cavities::fill) line += " --cavities fill";
  if (o.extract.touching == Touching::join) line += " --touching join";
  if (o.certify.precision == Precision::float32) line += " --precision float32";
  if (o.certify.welded) line += " --format stl-ascii";
  std::printf("%s\nchange %d, chosen %04llx, %zu points, %zu triangles\n", line.c_str(),
              static_cast<int>(request.change),
              static_cast<unsigned long long>(request.chosen & 0xFFFF), request.soup.points.size(),
              request.soup.triangles.size());
}

int run(const char* input, const char* mesh) {
  std::ifstream file(input, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  FuzzInput numbers(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  const RepairRequest request = decode_request(numbers);
  show(request);
  write_soup(request.soup, mesh);
  return 0;
}

}  // namespace
}  // namespace meshrepair::testing

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs(meshrepair::testing::kUsage, stderr);
    return 2;
  }
  try {
    return meshrepair::testing::run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "show_repair_input: %s\n", error.what());
    return 3;
  }
}
