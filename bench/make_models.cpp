// SPDX-License-Identifier: MIT
// make_models FOLDER [KIND:N...]: writes the models of the tables as OFF files, or the generated
// inputs of these names.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include <base/error.h>
#include <mesh/soup_io.h>

#include "generated_inputs.h"
#include "models.h"
#include "shapes.h"

namespace {

using namespace meshrepair;

constexpr const char* kUsage = R"(Usage: make_models FOLDER [KIND:N...]

Writes the models of the paper's tables into FOLDER, as OFF; or inputs of these kinds, about N triangles each:
  clean    a sphere
  holes    a sphere without one in a hundred of its triangles
  bumpy    two bumpy spheres that overlap
  noisy    a sphere whose points are moved by up to an edge, so that neighbours cross
  cubes    N turned cubes, of 12 triangles each
  soup     a sphere whose triangles share no points, their corners moved by a millionth
  spheres  two spheres that overlap, with poles
  union    the two bodies of bumpy, in two files
  cloud    N random points on a torus, as XYZ

Example: make_models inputs clean:10000 cubes:1000
)";

void write_models(const std::filesystem::path& folder) {
  std::vector<bench::Model> models = bench::crossing_models();
  for (auto* make : {bench::blob, bench::bone, bench::truss, bench::pig, bench::helix})
    models.push_back(make());
  models.push_back({"sphere a", "", testing::sphere(100'000), {}});
  models.push_back({"sphere b", "", testing::sphere(100'000, 1, {0.7, 0.31, 0.17}), {}});
  for (bench::Model& model : models) {
    std::string file = model.name + ".off";
    for (char& c : file) c = c == ' ' ? '_' : c;
    write_soup(model.soup, folder / file, {});
    std::printf("%-10s %6zu triangles, %zu strands\n", model.name.c_str(),
                model.soup.triangles.size(), model.strands.size());
  }
}

void run(int argc, char** argv) {
  const std::filesystem::path folder(argv[1]);
  std::filesystem::create_directories(folder);
  if (argc == 2) write_models(folder);
  for (int i = 2; i < argc; ++i) {
    for (const std::filesystem::path& file : bench::write_generated(argv[i], folder)) {
      std::printf("%s\n", file.c_str());
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first.empty() || first.starts_with("-")) {
    const bool asked = first == "-h" || first == "--help";
    std::fputs(kUsage, asked ? stdout : stderr);
    return asked ? 0 : 2;
  }
  try {
    run(argc, argv);
  } catch (const meshrepair::UsageError& error) {
    std::fprintf(stderr, "make_models: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_models: %s\n", error.what());
    return 6;
  }
  return 0;
}
