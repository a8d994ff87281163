// make_models FOLDER: writes the models of the tables as OFF files.
#include <cstdio>
#include <filesystem>

#include <mesh/soup_io.h>

#include "models.h"
#include "shapes.h"

int main(int argc, char** argv) {
  using namespace meshrepair;
  if (argc != 2) {
    std::fprintf(stderr, "Usage: make_models FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder(argv[1]);
  std::filesystem::create_directories(folder);
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
  return 0;
}
