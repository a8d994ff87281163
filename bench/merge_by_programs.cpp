// SPDX-License-Identifier: MIT
// merge_by_programs A B OPERATION: how many seconds does it take to merge the trees of two solids
// where linear programs tell which regions there are, as in the paper, and not the cells of these?
#include <cstdio>
#include <exception>
#include <initializer_list>
#include <string_view>
#include <vector>

#include <base/error.h>
#include <boolean/boolean.h>
#include <mesh/soup_io.h>

using namespace meshrepair;

namespace {

SetOperation operation_of(std::string_view name) {
  for (const SetOperation operation : {SetOperation::unite, SetOperation::intersect,
                                       SetOperation::subtract, SetOperation::exclude}) {
    if (operation_name(operation) == name) return operation;
  }
  throw UsageError("no operation has this name");
}

int run(const char* const* words) {
  const std::vector<TriangleSoup> solids = {read_soup(words[1]).soup, read_soup(words[2]).soup};
  BooleanOptions options;
  options.test = RegionTest::linear_programs;
  BooleanReport report;
  (void)boolean_tree(solids, operation_of(words[3]), options, report);
  double seconds = 0;
  for (const StageReport& stage : report.result.stages) {
    if (stage.name == "merge") seconds += stage.seconds;
  }
  std::printf("%g\n", seconds);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "Usage: merge_by_programs A B union|intersection|difference|xor\n");
    return 2;
  }
  try {
    return run(argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "merge_by_programs: %s\n", error.what());
    return 1;
  }
}
