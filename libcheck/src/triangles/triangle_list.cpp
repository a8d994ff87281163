// SPDX-License-Identifier: MIT
#include <utility>

#include <base/parallel.h>
#include <check/internal/triangle_list.h>
#include <exact/double_predicates.h>
#include <mesh/weld_points.h>

namespace meshrepair::internal {
namespace {

// A millisecond of work.
constexpr std::size_t kFetchesPerTask = 8192;

}  // namespace

Box box_of(const TriangleSoup& soup, std::uint32_t triangle) {
  Box box;
  for (const std::uint32_t p : soup.triangles[triangle]) box.add(soup.points[p]);
  return box;
}

SoupCorners::SoupCorners(const TriangleSoup& soup, bool weld)
    : soup_(soup), end_(soup.points.size()) {
  if (weld) welded_ = first_in_place(soup.points);
}

Fetched SoupCorners::fetch(std::uint32_t triangle, CornerTriangle& fetched) const {
  const auto& corners = soup_.triangles[triangle];
  for (std::size_t k = 0; k < 3; ++k) {
    fetched.at[k] = soup_.points[corners[k]];
    if (!fetched.at[k].allFinite()) return Fetched::not_finite;
    fetched.corner[k] = corner(corners[k]);
  }
  fetched.axis = projection_axis(fetched.at[0], fetched.at[1], fetched.at[2]);
  return fetched.axis < 0 ? Fetched::degenerate : Fetched::usable;
}

TriangleList::TriangleList(const SoupCorners& corners) : corners_(corners) {
  const std::size_t count = corners.soup().triangles.size();
  add(count, [](std::size_t i) { return static_cast<std::uint32_t>(i); });
}

TriangleList::TriangleList(const SoupCorners& corners, std::span<const std::uint32_t> among)
    : corners_(corners) {
  std::vector<std::uint32_t> once;
  std::vector<char> seen(corners.soup().triangles.size(), 0);
  for (const std::uint32_t id : among) {
    if (seen[id] == 0) once.push_back(id);
    seen[id] = 1;
  }
  add(once.size(), [&](std::size_t i) { return once[i]; });
}

CornerTriangle TriangleList::triangle(std::uint32_t i) const {
  CornerTriangle fetched;
  (void)corners_.fetch(ids_[i], fetched);  // it was usable
  return fetched;
}

template <class IdOf>
void TriangleList::add(std::size_t count, const IdOf& id_of) {
  struct Found {
    std::size_t usable = 0, degenerate = 0, not_finite = 0;
  };
  RawVector<Fetched> state(count);
  std::vector<Found> before(tasks_of(count, kFetchesPerTask));  // first of each task alone
  parallel_tasks(count, kFetchesPerTask,
                 [&](std::size_t task, std::size_t first, std::size_t last) {
                   CornerTriangle triangle;
                   Found& found = before[task];
                   for (std::size_t i = first; i < last; ++i) {
                     state[i] = corners_.fetch(id_of(i), triangle);
                     found.usable += state[i] == Fetched::usable ? 1 : 0;
                     found.degenerate += state[i] == Fetched::degenerate ? 1 : 0;
                     found.not_finite += state[i] == Fetched::not_finite ? 1 : 0;
                   }
                 });
  std::size_t usable = 0;
  for (Found& found : before) {
    degenerate_ += found.degenerate;
    not_finite_ += found.not_finite;
    usable += std::exchange(found.usable, usable);
  }
  boxes_.resize(usable);
  ids_.resize(usable);
  parallel_tasks(count, kFetchesPerTask,
                 [&](std::size_t task, std::size_t first, std::size_t last) {
                   std::size_t place = before[task].usable;
                   for (std::size_t i = first; i < last; ++i) {
                     if (state[i] != Fetched::usable) continue;
                     ids_[place] = id_of(i);
                     boxes_[place++] = box_of(corners_.soup(), id_of(i));
                   }
                 });
}

}  // namespace meshrepair::internal
