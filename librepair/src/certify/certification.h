// SPDX-License-Identifier: MIT
// A surface on its way to its certificate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <base/progress.h>
#include <check/internal/known_intersections.h>
#include <check/self_intersections.h>
#include <exact/grid.h>
#include <extract/surface.h>
#include <mesh/soup.h>
#include <repair/certify.h>

namespace meshrepair::internal {

// Rounds coordinates to the precision and tests exactly for triangles that intersect or have no
// area. Where it finds some, the caller may ask it, in this order, to bring their input corners
// onto the working grid, where every decision was exact; to mend what is left place by place; to
// give each group of parts that has faults to the caller, who certifies it by itself; to give the
// few places that are left to the caller, who repairs them; and, round by round, to bring all their
// corners onto this and coarser grids, for the caller to repair what comes of that. result() is the
// best of all these.
//
// Points of the input that are not concerned stay where they are. Parts that take part in faults
// and are no thicker than two steps of the numbers are dropped, as are those so thin that rounding
// turned them inside out; or turned where there is nothing else. Thicker ones that face the wrong
// way are counted and left. Surface::source keeps naming triangles of the first input.
class Certification {
 public:
  // Tests. What is referred to has to outlive this.
  Certification(Surface surface, const Grid& grid, const CertifyOptions& options,
                ProgressObserver* progress, CertifyReport& report);

  // Whether input points may be what is at fault, as they are written with their own coordinates.
  [[nodiscard]] bool may_settle() const;
  // The surface, its input points on the working grid as far as triangles would intersect.
  [[nodiscard]] Surface settled(Surface surface);
  void settle();
  // With a surface that was made again from one that is settled(): needed where the surface was
  // changed since it was decided on.
  void start_again(Surface surface);

  // Moves points, collapses and turns edges, as long as that is of use.
  void mend_in_place();

  // The groups that have faults, to be certified one by one and to be given back, all of them; then
  // the rest of this is about what the groups have to do with each other. None if all of the
  // surface is one group.
  [[nodiscard]] std::vector<Surface> take_faulty_groups();
  // Of the work on all groups.
  [[nodiscard]] ProgressObserver* groups_progress() { return &progress_; }
  // `group` is of no use afterwards.
  void give_back(Certification& group);
  void end_groups();

  // Whether sheets cross in so few places that repairing the surface again may do, with its points
  // where they are.
  [[nodiscard]] bool are_few_places() const;
  [[nodiscard]] const Surface& begin_places();
  // The same with the corners at fault on a grid, which gets coarser each time: where they are, it
  // was in vain.
  [[nodiscard]] bool may_snap_places() const;
  [[nodiscard]] Surface begin_snapped_places();
  // With what that gave, whose sources are triangles of that surface.
  void end_places(Surface again);

  // Whether another round may be of use.
  [[nodiscard]] bool may_go_on() const;
  // The mesh with the corners at fault on a coarser grid: its sheets may cross there.
  [[nodiscard]] const Surface& begin_round();
  // With what repairing it again gave, whose sources are triangles of that mesh.
  void end_round(Surface again);

  // The best surface; completes the report. To be called once, last.
  [[nodiscard]] Surface result();

 private:
  struct Attempt {
    Surface surface;
    SelfIntersections found;
    std::size_t joined = 0;
    std::size_t dropped_parts = 0;
    std::size_t inside_out_parts = 0;  // known where nothing intersects
    // What moving points and repairing again may mend.
    [[nodiscard]] std::size_t misplaced() const { return found.count + found.degenerate + joined; }
    [[nodiscard]] std::size_t faults() const { return misplaced() + inside_out_parts; }
  };

  // `before`: where the points were before they were moved, if not just before rounding.
  void test(Attempt& attempt, std::vector<Vec3d> before = {});
  void drop_inside_out(Attempt& attempt);
  std::size_t drop_thin_at_fault(Attempt& attempt) const;
  [[nodiscard]] double reach() const;
  [[nodiscard]] bool may_move_points() const;
  [[nodiscard]] bool has_few_places() const;
  void improve(Attempt moved);
  void move_points(Attempt& attempt);
  bool mend_places(Attempt& attempt);
  void separate(Attempt& attempt);
  void keep_if_better(const Attempt& attempt);
  [[nodiscard]] bool is_whole(const Attempt& attempt) const;
  void snap_cut_triangles();

  const Grid& grid_;
  const CertifyOptions& options_;
  HalvedStage progress_;
  CertifyReport& report_;
  KnownIntersections known_;
  double spacing_ = 0;  // of the numbers that can be written
  double step_ = 0;     // of the finest grid
  double volume_ = 0;   // as given
  double area_ = 0;     // as given
  double most_lost_ = 0;

  std::size_t faults_of_groups_ = 0;  // that are left in those that were given back

  std::size_t places_repaired_ = 0, snaps_ = 0;  // how often few places were
  std::size_t last_places_ = ~std::size_t{0};    // faults when places were last begun

  // Of the rounds.
  double round_step_ = 0;           // of the next one's grid
  std::size_t most_triangles_ = 0;  // more would only become ever more
  std::size_t vain_rounds_ = 0;     // in a row
  std::size_t faults_before_ = 0;   // of the best attempt, when the round began

  Attempt current_, best_;
};

}  // namespace meshrepair::internal
