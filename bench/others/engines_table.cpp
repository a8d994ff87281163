// SPDX-License-Identifier: MIT
// engines_table MODEL: from a labelled tree to the mesh with three engines of predicates: ours, the
// paper's floating one, and the paper's exact one (a filter, then GMP). Prints a line of JSON.
#include <array>
#include <chrono>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <boolean/boolean.h>
#include <extract/build_cells.h>
#include <extract/cover_facets.h>
#include <extract/extract_surface.h>
#include <extract/float_engine.h>
#include <repair/repair.h>

#include "../bench_cases.h"
#include "../models.h"
#include "gmp_engine.h"

using namespace meshrepair;
using Json = nlohmann::ordered_json;

namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Asks another engine, and asks it all questions again in a row, to learn how long they take
// without a clock between any two.
class TimedEngine final : public PredicateEngine {
 public:
  explicit TimedEngine(PredicateEngine& engine) : engine_(engine) { questions_.reserve(kBatch); }

  [[nodiscard]] bool exact() const override { return engine_.exact(); }
  [[nodiscard]] double tolerance() const override { return engine_.tolerance(); }
  int side(const Point& point, PlaneId plane, const PlaneTable& planes) override {
    questions_.push_back({point, plane});
    if (questions_.size() == kBatch) ask_again(planes);
    return engine_.side(point, plane, planes);
  }
  Point cross(const Point& a, const Point& b, PlaneId p, PlaneId q, PlaneId plane,
              const PlaneTable& planes) override {
    return engine_.cross(a, b, p, q, plane, planes);
  }

  void ask_again(const PlaneTable& planes) {
    const double start = seconds();
    for (const Question& q : questions_) sum_ = sum_ + engine_.side(q.point, q.plane, planes);
    seconds_ += seconds() - start;
    calls_ += questions_.size();
    questions_.clear();
  }
  [[nodiscard]] double spent() const { return seconds_; }
  [[nodiscard]] std::size_t calls() const { return calls_; }

 private:
  static constexpr std::size_t kBatch = 4096;

  struct Question {
    Point point;
    PlaneId plane;
  };

  PredicateEngine& engine_;
  std::vector<Question> questions_;
  double seconds_ = 0;
  std::size_t calls_ = 0;
  volatile int sum_ = 0;  // so that the answers are needed
};

std::size_t depth_of(const Tree& tree) {
  std::vector<std::size_t> depth(tree.nodes.size(), 1);
  std::size_t deepest = 0;
  for (NodeId n(0u); n < tree.nodes.end_id(); ++n.value) {
    deepest = std::max(deepest, depth[n.index()]);
    for (const TreeRef child : tree.nodes[n].child) {
      if (!child.is_leaf()) depth[child.node().index()] = depth[n.index()] + 1;
    }
  }
  return deepest;
}

Tree repaired_tree(const TriangleSoup& soup) {
  RepairReport report;
  Tree tree = make_tree(soup, {}, report);
  label_tree(tree, {}, report);
  return tree;
}

Tree combined_tree(const bench::Model& a, const bench::Model& b, SetOperation operation) {
  BooleanReport report;
  const std::array<TriangleSoup, 2> solids = {a.soup, b.soup};
  return boolean_tree(solids, operation, {}, report);
}

Tree tree_of(const std::string& name) {
  if (name == "bone-truss")
    return combined_tree(bench::bone(), bench::truss(), SetOperation::intersect);
  if (name == "pig-helix")
    return combined_tree(bench::pig(), bench::helix(), SetOperation::subtract);
  if (name == "blob") return repaired_tree(bench::blob().soup);
  for (const bench::Model& model : bench::crossing_models()) {
    if (model.name == name) return repaired_tree(model.soup);
  }
  throw std::invalid_argument("no model is called " + name);
}

CellComplex cells_of(const Tree& tree, PredicateEngine& engine, ClipReport& clip) {
  BuildCellsOptions options;
  options.engine = &engine;
  return build_cells(tree, options, clip);
}

Surface mesh_of(const Tree& tree, CellComplex& complex) {
  CoverReport report;
  const auto cover = cover_facets(complex, windings_of(tree.input), report);
  std::vector<char> solid;
  for (const Cell& cell : complex.cells) {
    solid.push_back(tree.leaves[cell.leaf].label == Label::solid ? 1 : 0);
  }
  ExtractReport extract;
  return extract_surface(complex, cover, solid, extract);
}

Json measure_engine(const Tree& tree, PredicateEngine& engine) {
  ClipReport clip;
  double clipping = 0;
  std::size_t triangles = 0;
  const double start = seconds();
  const bench::Measurement whole = bench::measure([&] {
    CellComplex complex = cells_of(tree, engine, clip);
    clipping = seconds() - start;
    triangles = mesh_of(tree, complex).mesh.triangles.size();
  });
  const double total = seconds() - start;
  TimedEngine timed(engine);
  {
    ClipReport again;
    const CellComplex complex = cells_of(tree, timed, again);
    timed.ask_again(complex.planes);
  }
  return {{"total_seconds", total},
          {"clip_seconds", clipping},
          {"predicate_seconds", timed.spent()},
          {"predicate_calls", timed.calls()},
          {"flood_seconds", clip.flood_seconds},
          {"several_groups", clip.several_groups},
          {"region_floods", clip.region_floods},
          {"several_regions", clip.several_regions},
          {"forced_cuts", clip.forced_cuts},
          {"peak_bytes", whole.peak_bytes},
          {"triangles", triangles}};
}

int run(const std::string& name) {
  const Tree tree = tree_of(name);
  ExactEngine exact;
  FloatEngine floating(tree.input, kDefaultEpsilon);
  bench::GmpEngine gmp;
  Json row = {{"model", name}, {"nodes", tree.nodes.size()}, {"depth", depth_of(tree)}};
  row["exact"] = measure_engine(tree, exact);
  row["float"] = measure_engine(tree, floating);
  row["gmp"] = measure_engine(tree, gmp);
  row["gmp"]["exact_calls"] = gmp.exact_calls();
  std::printf("%s\n", row.dump().c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr,
                 "Usage: engines_table ship|harp|spider|turtle|head|cow|\"oil "
                 "rig\"|blob|bone-truss|pig-helix\n");
    return 2;
  }
  try {
    return run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "engines_table: %s\n", error.what());
    return 1;
  }
}
