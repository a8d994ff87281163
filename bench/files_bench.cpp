// SPDX-License-Identifier: MIT
// How long do writing and reading take, in every format?
#include <string>
#include <utility>

#include <mesh/soup_io.h>

#include "bench_cases.h"

using namespace meshrepair;

namespace {

struct Bytes {
  std::string text;
};

}  // namespace

int main(int argc, char** argv) {
  const std::pair<SoupFormat, const char*> formats[] = {
      {SoupFormat::stl_binary, "a.stl"}, {SoupFormat::stl_ascii, "a.stl"},
      {SoupFormat::obj, "a.obj"},        {SoupFormat::off, "a.off"},
      {SoupFormat::ply_binary, "a.ply"}, {SoupFormat::ply_ascii, "a.ply"}};
  for (const auto& [format, name] : formats) {
    const SoupFormat f = format;
    const char* const file = name;
    bench::run_cases<const TriangleSoup*>(
        argc, argv, "write " + std::string(format_name(f)),
        [](const TriangleSoup& soup) { return &soup; },
        [&](const TriangleSoup*& soup) {
          return std::to_string(format_soup(*soup, f).size()) + " bytes";
        });
    bench::run_cases<Bytes>(
        argc, argv, "read " + std::string(format_name(f)),
        [&](const TriangleSoup& soup) { return Bytes{format_soup(soup, f)}; },
        [&](Bytes& bytes) {
          return std::to_string(read_soup(bytes.text, file).soup.points.size()) + " points";
        });
  }
  return 0;
}
