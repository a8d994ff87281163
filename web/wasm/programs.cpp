// SPDX-License-Identifier: MIT
// The programs as a function, which node calls with the words of the command line.
#include <algorithm>
#include <array>
#include <string_view>

int main_of_bspbool(int argc, char** argv);
int main_of_bspbuild(int argc, char** argv);
int main_of_bspextract(int argc, char** argv);
int main_of_bspsolid(int argc, char** argv);
int main_of_meshbodies(int argc, char** argv);
int main_of_meshcheck(int argc, char** argv);
int main_of_meshconvert(int argc, char** argv);
int main_of_meshdist(int argc, char** argv);
int main_of_meshrepair(int argc, char** argv);
int main_of_meshrepair_blocks(int argc, char** argv);
int main_of_pointmesh(int argc, char** argv);

namespace {

struct ProgramOfModule {
  std::string_view name;
  int (*main)(int argc, char** argv);
};

constexpr std::array<ProgramOfModule, 11> kPrograms = {{
    {"bspbool", main_of_bspbool},
    {"bspbuild", main_of_bspbuild},
    {"bspextract", main_of_bspextract},
    {"bspsolid", main_of_bspsolid},
    {"meshbodies", main_of_meshbodies},
    {"meshcheck", main_of_meshcheck},
    {"meshconvert", main_of_meshconvert},
    {"meshdist", main_of_meshdist},
    {"meshrepair", main_of_meshrepair},
    {"meshrepair-blocks", main_of_meshrepair_blocks},
    {"pointmesh", main_of_pointmesh},
}};

}  // namespace

// The exit code of the program that the first word names; -1: there is none of this name.
extern "C" int meshrepair_run_program(int argc, char** argv) {
  const auto* const program = std::find_if(kPrograms.begin(), kPrograms.end(),
                                           [&](const auto& one) { return one.name == argv[0]; });
  return program == kPrograms.end() ? -1 : program->main(argc, argv);
}
