#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include <bsp/error.h>
#include <extract/build_cells.h>
#include <repair/cell_graph.h>
#include <repair/flood.h>
#include <repair/repair.h>
#include <repair/thin_cells.h>

#include "describe_result.h"
#include "drop_thin_parts.h"
#include "keep_valid.h"
#include "number_spacing.h"
#include "settle_points.h"

namespace meshrepair {
namespace {

// As many as this may be chance.
constexpr std::size_t kFewFaults = 32;

// Of the numbers of the format: nearer sheets are not told apart.
constexpr double kSlitSteps = 4;

struct CoveredCells {
  CellComplex complex;
  IdVector<FacetId, Cover> cover;
  std::vector<CoverLayer> layers;
};

CoveredCells make_cells(const Tree& tree, const IdVector<TriangleId, std::int32_t>& winding,
                        const RepairOptions& options, RepairReport& report, StageMeter& meter) {
  meter.begin("cells");
  BuildCellsOptions cell_options;
  cell_options.check_every_clip = options.check_cells;
  cell_options.progress = options.progress;
  std::optional<FloatEngine> engine;
  report.predicates = options.predicates;
  if (options.predicates == Predicates::floating) {
    report.epsilon = options.epsilon;
    cell_options.engine = &engine.emplace(tree.input, options.epsilon);
  }
  CoveredCells covered{build_cells(tree, cell_options, report.clip), {}, {}};
  report.cells = covered.complex.cells.size();
  meter.begin("cover");
  // Only `automatic` turns parts, and asks what else lies on a facet.
  auto* layers = options.inside.rule == InsideRule::automatic ? &covered.layers : nullptr;
  covered.cover = cover_facets(covered.complex, winding, report.cover, options.progress, layers);
  report.facets = covered.complex.facets.size();
  return covered;
}

// The parts of the input: oriented for `automatic`, else as they are connected through edges, which
// does not depend on how their triangles are turned.
Orientation find_parts(const CleanSoup& soup, const RepairOptions& options, RepairReport& report) {
  if (options.inside.rule == InsideRule::automatic) {
    return orient_parts(soup, report.orient, options.progress);
  }
  TopologyPlaces places;
  report.orient.parts = examine_topology(index_triangles(soup), soup.points.size(), &places).parts;
  Orientation as_given;
  as_given.winding = windings_of(soup);
  for (const std::uint32_t part : places.parts) as_given.part_of.push_back(part);
  return as_given;
}

// Known before any work, and worth asking: overlaps in one plane fall into very many pieces.
void require_space(const CleanSoup& soup) {
  if (soup.triangles.empty()) return;
  const PlaneId first = soup.triangles[TriangleId(0u)].plane;
  if (std::all_of(soup.triangles.begin(), soup.triangles.end(),
                  [&](const Triangle& t) { return t.plane == first; })) {
    throw NoSolidError("all triangles lie in one plane, so they enclose nothing");
  }
}

// Only what the triangles seal off by themselves.
void drop_unsealed(const CellGraph& graph, ProgressObserver* progress, CellLabels& labels,
                   InsideReport& report) {
  const std::vector<char> sealed =
      flood_from_infinity(graph, std::vector<char>(graph.cells(), 1), progress);
  for (std::size_t i = 0; i < sealed.size(); ++i) {
    if (sealed[i] != 0 || labels.solid[i] == 0) continue;
    labels.solid[i] = 0;
    --report.solid_cells;
  }
}

std::string why_nothing_is_solid(const RepairReport& report, HoleMode mode) {
  std::string why = "the triangles enclose nothing: ";
  if (mode == HoleMode::none && report.input.open_edges > 0) {
    return why + "holes are not to be closed, and every part has some";
  }
  if (report.holes.too_large > 0) {
    return why + "open sheets, whose rims are too large for holes (" +
           std::to_string(report.holes.too_large) + ")";
  }
  return why + "no part of space is inside";
}

// Of the first copy of each triangle; those that close holes are opaque.
IdVector<TriangleId, float> opacities_of(const CleanSoup& soup,
                                         const std::vector<float>& of_input) {
  IdVector<TriangleId, float> opacity;
  opacity.reserve(soup.triangles.size());
  for (const Triangle& t : soup.triangles) {
    opacity.push_back(t.source < of_input.size() ? of_input[t.source] : 1.0f);
  }
  return opacity;
}

CellLabels find_solid(const CoveredCells& covered, const Orientation& orientation,
                      const RepairOptions& options, RepairReport& report, StageMeter& meter) {
  meter.begin("links");
  CellGraph graph(covered.complex, covered.cover, options.progress, covered.layers);
  if (!options.opacity.empty()) {
    graph.set_opacities(opacities_of(covered.complex.soup(), options.opacity));
  }
  report.links = graph.links().size();
  meter.begin("inside");
  InsideOptions inside_options = options.inside;
  inside_options.solve.progress = options.progress;
  CellLabels labels = label_cells(graph, orientation, inside_options, report.inside);
  if (options.holes.mode == HoleMode::none) {
    drop_unsealed(graph, options.progress, labels, report.inside);
  }
  if (report.inside.solid_cells == 0) {
    throw NoSolidError(why_nothing_is_solid(report, options.holes.mode));
  }
  return labels;
}

// Cleaned, its holes closed.
CleanSoup close_soup(const TriangleSoup& soup, const RepairOptions& options, RepairReport& report,
                     StageMeter& meter) {
  meter.begin("clean");
  CleanSoup clean = clean_soup(soup, report.clean, options.progress);
  report.input = examine_topology(index_triangles(clean), clean.points.size());
  report.input_area = 0;
  for (const Triangle& t : clean.triangles) report.input_area += area_of(clean, t);
  report.holes = {};
  if (clean.triangles.empty()) {
    throw NoSolidError(
        "no triangle is left: all are degenerate, or smaller than the working grid of 2^26 steps "
        "over "
        "their bounding box, or have coordinates that are not finite");
  }
  if (report.input.open_edges > 0 || report.input.nonmanifold_edges > 0) {
    meter.begin("holes");
    patch_holes(clean, options.holes, report.holes, options.progress);
  }
  return clean;
}

Tree make_tree(CleanSoup clean, const RepairOptions& options, RepairReport& report,
               StageMeter& meter) {
  meter.begin("tree");
  BuildTreeOptions tree_options = options.tree;
  tree_options.progress = options.progress;
  return build_tree(std::move(clean), tree_options, report.tree);
}

std::vector<char> solid_cells(const Tree& tree, const CellComplex& complex) {
  std::vector<char> solid;
  solid.reserve(complex.cells.size());
  for (const Cell& cell : complex.cells) {
    solid.push_back(tree.leaves[cell.leaf].label == Label::solid ? 1 : 0);
  }
  return solid;
}

void require_labels(const Tree& tree) {
  bool any_solid = false;
  for (const Leaf& leaf : tree.leaves) {
    if (leaf.label == Label::unknown) {
      throw InputError("the tree is not labelled: run bspsolid on it first");
    }
    any_solid |= leaf.label == Label::solid;
  }
  if (!any_solid) throw NoSolidError("no leaf of the tree is solid");
}

}  // namespace

std::string_view predicates_name(Predicates predicates) {
  return predicates == Predicates::exact ? "exact" : "float";
}

Tree make_tree(const TriangleSoup& soup, const RepairOptions& options, RepairReport& report) {
  StageMeter meter(report.stages, options.progress);
  return make_tree(close_soup(soup, options, report, meter), options, report, meter);
}

void label_tree(Tree& tree, const RepairOptions& options, RepairReport& report) {
  StageMeter meter(report.stages, options.progress);
  require_space(tree.input);
  meter.begin("orient");
  const Orientation orientation = find_parts(tree.input, options, report);
  const CoveredCells covered = make_cells(tree, orientation.winding, options, report, meter);
  const CellLabels labels = find_solid(covered, orientation, options, report, meter);
  for (CellId c(0u); c < covered.complex.cells.end_id(); ++c.value) {
    tree.leaves[covered.complex.cells[c].leaf] = {
        labels.solid[c.index()] != 0 ? Label::solid : Label::empty, labels.confidence[c.index()]};
  }
}

namespace {

// Orientation is sound by now, and overlaps made by moving points are to be united.
Surface repair_again(const TriangleSoup& soup, const RepairOptions& options) {
  CancelOnly quiet(options.progress);
  RepairOptions again = options;
  again.inside.rule = InsideRule::winding;
  again.holes = {};
  again.opacity.clear();
  again.examine = nullptr;
  again.keep_valid = false;
  again.certify.wanted = false;
  again.progress = &quiet;
  RepairReport report;
  return repair(soup, again, report);
}

// Sheets so near to each other would cross once they are written.
void fill_slits(const CoveredCells& covered, const RepairOptions& options, std::vector<char>& solid,
                RepairReport& report) {
  report.thin_cells = {};
  report.slits_area = report.fins_area = 0;
  if (options.certify.precision == Precision::float64 || covered.complex.loose) return;
  const CleanSoup& soup = covered.complex.soup();
  double farthest = 0;
  for (const Vec3d& p : soup.points) farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
  const double spacing = internal::number_spacing(farthest, options.certify.precision);
  const double unit = soup.grid.unit;
  report.thin_cells = relabel_thin_cells(covered.complex, covered.cover,
                                         kSlitSteps * spacing / unit, solid, options.progress);
  report.slits_area = report.thin_cells.filled_area * unit * unit;
  report.fins_area = report.thin_cells.emptied_area * unit * unit;
}

Surface extract(const CoveredCells& covered, std::vector<char> solid, const RepairOptions& options,
                RepairReport& report) {
  fill_slits(covered, options, solid, report);
  report.parts = find_part_fates(covered.complex, covered.cover, solid);
  ExtractOptions extract_options = options.extract;
  extract_options.progress = options.progress;
  return extract_surface(covered.complex, covered.cover, solid, report.extract, extract_options);
}

// Whatever is beyond would be written as infinity.
void require_range(const Surface& surface, Precision precision) {
  if (precision == Precision::float64) return;
  for (const Vec3d& p : surface.mesh.points) {
    if (p.cwiseAbs().maxCoeff() <= static_cast<double>(std::numeric_limits<float>::max())) continue;
    throw OutputError(
        "coordinates are too large for single precision: write OBJ, OFF or PLY in double "
        "precision");
  }
}

// What is thinner than a step of the grid says nothing about the input, whose points were put
// there. Returns which of the triangles left are whole.
std::vector<char> drop_crumbs(const CleanSoup& input, Surface& surface, RepairReport& report) {
  std::vector<char> whole = find_whole_triangles(input, surface);
  report.crumbs = internal::drop_thin_crumbs(surface, whole, input.grid.unit);
  return report.crumbs > 0 ? find_whole_triangles(input, surface) : std::move(whole);
}

// What was never cut is to stay as it was.
std::vector<char> points_of(const Surface& surface, const std::vector<char>& whole) {
  std::vector<char> points(surface.mesh.points.size(), 0);
  for (std::size_t t = 0; t < whole.size(); ++t) {
    if (whole[t] == 0) continue;
    for (const std::uint32_t p : surface.mesh.triangles[t]) points[p] = 1;
  }
  return points;
}

std::optional<Surface> simplify(const Surface& surface, std::vector<char>& stays,
                                const RepairOptions& options, SimplifyReport& report) {
  Eigen::AlignedBox3d box;
  for (const Vec3d& p : surface.mesh.points) box.extend(p);
  SimplifyOptions simplify_options;
  simplify_options.within = options.simplify * (box.max() - box.min()).stableNorm();
  simplify_options.progress = options.progress;
  return simplify_cuts(surface, stays, simplify_options, report);
}

Surface certify(Surface surface, const Grid& grid, const RepairOptions& options,
                CertifyReport& report, std::function<Surface()> settle_again = {}) {
  CertifyOptions certify_options = options.certify;
  certify_options.touching = options.extract.touching;
  if (options.predicates != Predicates::exact) certify_options.most_rounds = 0;
  const CertifyHelp help{[&](const TriangleSoup& soup) { return repair_again(soup, options); },
                         std::move(settle_again)};
  return certify(std::move(surface), grid, certify_options, help, options.progress, report);
}

// Where few faults are left after all rounds of mending, the surface with all its triangles may
// have none. Many are left where the surface is finer than the numbers, and would be again.
// `stays`: points that were not simplified away.
Surface certify(Surface surface, std::optional<Surface> simpler, std::vector<char> stays,
                const Grid& grid, const RepairOptions& options, RepairReport& report,
                StageMeter& meter) {
  meter.begin("certify");
  if (!simpler) return certify(std::move(surface), grid, options, report.certify);
  const auto settle_again = [&] {
    Surface settled = surface;
    internal::settle_input_points(settled, grid, options.progress);
    const SimplifyReport before = report.simplify;
    std::optional<Surface> again = simplify(settled, stays, options, report.simplify);
    report.simplify.rounds += before.rounds;
    report.simplify.points_to_stay += before.points_to_stay;
    return again ? std::move(*again) : settled;
  };
  Surface first = certify(std::move(*simpler), grid, options, report.certify, settle_again);
  if (report.certify.passed() || report.certify.faults() > kFewFaults) return first;
  RepairOptions plain = options;
  plain.simplify = 0;
  plain.certify.most_rounds = std::min<std::size_t>(plain.certify.most_rounds, 1);
  CertifyReport certified;
  meter.begin("certify");
  surface = certify(std::move(surface), grid, plain, certified);
  if (!certified.passed()) return first;
  report.simplify = {};
  report.certify = certified;
  return surface;
}

Surface finish(const CleanSoup& input, Surface surface, const RepairOptions& options,
               RepairReport& report, StageMeter& meter) {
  require_range(surface, options.certify.precision);
  const std::vector<char> whole = drop_crumbs(input, surface, report);
  if (options.examine) {
    internal::describe_result(input, surface, report);
    options.examine(report);
  }
  std::optional<Surface> simpler;
  std::vector<char> stays;
  if (options.simplify > 0) {
    meter.begin("simplify");
    stays = points_of(surface, whole);
    simpler = simplify(surface, stays, options, report.simplify);
  }
  if (options.certify.wanted) {
    surface = certify(std::move(surface), std::move(simpler), std::move(stays), input.grid, options,
                      report, meter);
  } else if (simpler) {
    surface = std::move(*simpler);
  }
  meter.begin("check");
  internal::describe_result(input, surface, report);
  return surface;
}

}  // namespace

Surface extract_mesh(const Tree& tree, const RepairOptions& options, RepairReport& report) {
  require_labels(tree);
  StageMeter meter(report.stages, options.progress);
  Surface surface;
  {
    const CoveredCells covered = make_cells(tree, windings_of(tree.input), options, report, meter);
    meter.begin("extract");
    surface = extract(covered, solid_cells(tree, covered.complex), options, report);
  }
  return finish(tree.input, std::move(surface), options, report, meter);
}

Surface repair(const TriangleSoup& soup, const RepairOptions& options, RepairReport& report) {
  StageMeter meter(report.stages, options.progress);
  if (auto kept = internal::keep_as_given(soup, options, report, meter)) return std::move(*kept);
  CleanSoup clean = close_soup(soup, options, report, meter);
  require_space(clean);
  meter.begin("orient");
  const Orientation orientation = find_parts(clean, options, report);
  if (auto mended = internal::keep_mended(clean, orientation, options, report, meter)) {
    return std::move(*mended);
  }
  Tree tree = make_tree(std::move(clean), options, report, meter);
  Surface surface;
  {
    const CoveredCells covered = make_cells(tree, orientation.winding, options, report, meter);
    // From here on only the input is needed, not the partition.
    tree.nodes = {};
    tree.node_triangles = {};
    tree.leaves = {};
    const CellLabels labels = find_solid(covered, orientation, options, report, meter);
    meter.begin("extract");
    surface = extract(covered, labels.solid, options, report);
  }
  return finish(tree.input, std::move(surface), options, report, meter);
}

RepairResult repair(const TriangleSoup& soup, const RepairOptions& options) {
  RepairResult result;
  result.surface = repair(soup, options, result.report);
  return result;
}

}  // namespace meshrepair
