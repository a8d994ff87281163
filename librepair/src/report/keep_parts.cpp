// SPDX-License-Identifier: MIT
// Idea: the nesting of closed parts tells solids from voids: a part with an even number of others
// around it is the shell of a solid, one with an odd number the wall of a void in the solid whose
// shell is the innermost part around it. So parts come and go in groups, a shell with its walls.
// Where a group goes and what is in its voids stays, that has two parts fewer around it, and faces
// as it did.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <base/ids.h>
#include <check/box_tree.h>
#include <check/part_orientation.h>
#include <mesh/mesh_parts.h>
#include <mesh/topology.h>
#include <repair/explain_repair.h>
#include <repair/keep_parts.h>
#include <repair/repair_report.h>

#include "describe_result.h"

namespace meshrepair {
namespace {

// A part of the surface.
struct Shell {
  bool is_void = false;
  std::uint32_t solid = 0;  // the shell of the solid that it belongs to, itself if it is that one
  bool is_inner = false;    // in a void of another solid
  double volume = 0;        // scaled, of what it is around
  double solid_volume = 0;  // of a solid's shell: without its voids
  std::size_t triangles = 0;
  Box box;
  bool stays = true;
};

class PartKeeper {
 public:
  PartKeeper(const TriangleSoup& input, Surface& surface, const KeepPartsOptions& options,
             RepairReport& report, ProgressObserver* progress)
      : input_(input),
        surface_(surface),
        options_(options),
        report_(report),
        found_(examine_part_orientation(surface.mesh, progress)),
        scale_(surface.mesh.points) {}

  void run() {
    find_shells();
    report_.keep.done = true;
    for (const Shell& shell : shells_) ++(shell.is_void ? report_.keep.voids : report_.keep.solids);
    drop_inner();
    drop_small();
    drop_voids();
    list_removed();
    if (!report_.keep.removed.empty()) remove();
  }

 private:
  void find_shells() {
    const auto count = static_cast<std::uint32_t>(found_.depth.size());
    const std::vector<PartSize> sizes =
        part_sizes(surface_.mesh.points, surface_.mesh.triangles, found_.part_of, count, scale_);
    shells_.resize(count);
    for (std::uint32_t s = 0; s < count; ++s) {
      Shell& shell = shells_[s];
      shell.is_void = found_.depth[s] % 2 != 0;
      shell.solid = shell.is_void ? found_.around[s] : s;
      shell.is_inner = found_.depth[s] > 1;
      shell.volume = std::abs(sizes[s].volume);
    }
    for (const Shell& shell : shells_) {
      shells_[shell.solid].solid_volume += shell.is_void ? -shell.volume : shell.volume;
    }
    for (std::size_t t = 0; t < found_.part_of.size(); ++t) {
      Shell& shell = shells_[found_.part_of[t]];
      ++shell.triangles;
      for (const std::uint32_t p : surface_.mesh.triangles[t]) {
        shell.box.add(surface_.mesh.points[p]);
      }
    }
  }

  void drop_inner() {
    if (!options_.outer && !options_.fill_voids) return;
    for (Shell& shell : shells_) shell.stays = !shell.is_inner;
  }

  [[nodiscard]] double volume_of(const Shell& solid) const {
    return options_.fill_voids ? solid.volume : solid.solid_volume;
  }

  // Of what is left, the solids that are too small or too many.
  void drop_small() {
    std::vector<std::uint32_t> solids;
    for (std::uint32_t s = 0; s < shells_.size(); ++s) {
      if (shells_[s].stays && !shells_[s].is_void) solids.push_back(s);
    }
    std::stable_sort(solids.begin(), solids.end(), [&](std::uint32_t a, std::uint32_t b) {
      return volume_of(shells_[a]) > volume_of(shells_[b]);
    });
    for (std::size_t i = 0; i < solids.size(); ++i) {
      Shell& solid = shells_[solids[i]];
      const bool too_many = options_.most > 0 && i >= options_.most;
      const bool too_small =
          volume_of(solid) < options_.smallest_share * volume_of(shells_[solids[0]]);
      solid.stays = !too_many && !too_small;
    }
  }

  void drop_voids() {
    for (Shell& shell : shells_) {
      if (shell.is_void) shell.stays = !options_.fill_voids && shells_[shell.solid].stays;
    }
  }

  // A wall goes with its solid, or by itself.
  void list_removed() {
    std::vector<RemovedPart>& removed = report_.keep.removed;
    std::vector<std::size_t> walls(shells_.size(), 0);  // triangles of each solid's
    for (const Shell& shell : shells_) {
      if (shell.is_void) walls[shell.solid] += shell.triangles;
    }
    const double unit = scale_(1.0);
    for (std::size_t s = 0; s < shells_.size(); ++s) {
      const Shell& shell = shells_[s];
      if (shell.stays || (shell.is_void && !shells_[shell.solid].stays)) continue;
      const double volume = shell.is_void ? shell.volume : shell.solid_volume;
      removed.push_back({shell.is_void, volume / unit / unit / unit, centre_of(shell.box),
                         shell.triangles + walls[s]});
    }
    std::stable_sort(removed.begin(), removed.end(), [](const auto& a, const auto& b) {
      return a.is_void != b.is_void ? b.is_void : a.volume > b.volume;
    });
  }

  static Vec3d centre_of(const Box& box) {
    Vec3d centre;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      centre[axis] = box.low[i] + (box.high[i] - box.low[i]) / 2;
    }
    return centre;
  }

  void remove() {
    std::vector<char> stays;
    stays.reserve(found_.part_of.size());
    for (const std::uint32_t part : found_.part_of) stays.push_back(shells_[part].stays ? 1 : 0);
    forget_triangles(stays);
    leave_out(surface_, stays, report_.explanation);
    keep_triangles(surface_, stays);
    internal::describe_output(surface_, report_);
    // Less is left than was given.
    if (std::exchange(report_.kept_valid, false)) report_.spared_cells = true;
  }

  // Of the input's triangles in the result, those that are in none of what stays.
  void forget_triangles(const std::vector<char>& stays) {
    enum : char { absent, goes, left };
    std::vector<char> fate(input_.triangles.size(), absent), whole(input_.triangles.size(), 0);
    for (std::size_t t = 0; t < stays.size(); ++t) {
      const std::uint32_t source = surface_.source[t];
      if (source == Surface::kNoSource) continue;
      if (stays[t] != 0) fate[source] = left;
      if (fate[source] == absent) fate[source] = goes;
      if (internal::has_corners_of_source(input_, surface_, t)) whole[source] = 1;
    }
    TriangleFates& fates = report_.triangles;
    for (std::size_t t = 0; t < fate.size(); ++t) {
      std::size_t& count = whole[t] != 0 ? fates.untouched : fates.cut;
      if (fate[t] != goes) continue;
      if (count > 0) --count;
    }
  }

  const TriangleSoup& input_;
  Surface& surface_;
  const KeepPartsOptions& options_;
  RepairReport& report_;
  const PartOrientation found_;
  const UnitScale scale_;
  std::vector<Shell> shells_;  // one for each part
};

}  // namespace

void keep_parts(const TriangleSoup& input, Surface& surface, const KeepPartsOptions& options,
                RepairReport& report, ProgressObserver* progress) {
  report.keep = {};
  report.keep.asked = options.wanted();
  if (!options.wanted() || surface.mesh.triangles.empty() || !report.output.closed()) return;
  CancelOnly quiet(progress);
  PartKeeper(input, surface, options, report, &quiet).run();
}

std::size_t drop_small_parts(Surface& surface, std::size_t fewest, RepairReport& report) {
  const MeshParts parts = find_parts(surface.mesh);
  std::vector<std::size_t> triangles(parts.count, 0);
  for (const std::uint32_t part : parts.of_triangle) ++triangles[part];
  const auto small =
      std::count_if(triangles.begin(), triangles.end(), [&](std::size_t n) { return n < fewest; });
  if (small == 0 || static_cast<std::size_t>(small) == triangles.size()) return 0;
  std::vector<char> keep;
  keep.reserve(parts.of_triangle.size());
  for (const std::uint32_t part : parts.of_triangle) keep.push_back(triangles[part] >= fewest);
  leave_out(surface, keep, report.explanation);
  keep_triangles(surface, keep);
  report.output = examine_topology(surface.mesh.triangles, surface.mesh.points.size());
  report.output_volume = signed_volume(surface.mesh);
  report.output_area = surface_area(surface.mesh);
  return static_cast<std::size_t>(small);
}

}  // namespace meshrepair
