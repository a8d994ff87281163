// SPDX-License-Identifier: MIT
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

std::string share(double value) { return std::to_string(100 * value) + "%"; }

std::string wishes_of(const RepairOptions& o) {
  std::string line = o.sew.mode == SewMode::automatic  ? " --sew auto"
                     : o.sew.mode == SewMode::distance ? " --sew " + share(o.sew.distance)
                                                       : " --sew none";
  if (o.seal.wanted()) line += " --seal " + (o.seal.automatic ? "auto" : share(o.seal.size));
  if (o.thicken.wanted()) {
    line += " --thicken " + (o.thicken.automatic ? "auto" : share(o.thicken.thickness));
    line += " --thicken-side " + std::string(thicken_side_name(o.thicken.side));
  }
  if (o.keep.outer) line += " --keep outer";
  if (o.keep.smallest_share > 0) line += " --min-part " + std::to_string(o.keep.smallest_share);
  if (o.keep.most > 0) line += " --keep " + std::to_string(o.keep.most);
  line += " --simplify " + std::to_string(o.simplify);
  if (!o.opacity.empty()) line += " (some triangles are less sure)";
  return line;
}

void show(const RepairRequest& request) {
  const RepairOptions& o = request.options;
  std::string line = "--inside " + std::string(rule_name(o.inside.rule));
  line += " --holes " + std::string(hole_mode_name(o.holes.mode));
  if (o.inside.cavities == Cavities::fill || o.keep.fill_voids) line += " --cavities fill";
  if (o.extract.touching == Touching::join) line += " --touching join";
  if (o.certify.precision == Precision::float32) line += " --precision float32";
  if (o.certify.welded) line += " --format stl-ascii";
  line += wishes_of(o);
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
