#include <check/triangle_list.h>
#include <exact/double_predicates.h>
#include <mesh/weld_points.h>

namespace meshrepair::internal {

Box box_of(const TriangleSoup& soup, std::uint32_t triangle) {
  Box box;
  for (const std::uint32_t p : soup.triangles[triangle]) box.add(soup.points[p]);
  return box;
}

SoupCorners::SoupCorners(const TriangleSoup& soup, bool weld)
    : soup_(soup), end_(soup.points.size()) {
  if (!weld) return;
  std::vector<Vec3d> distinct;
  PointWelder welder(distinct, soup.points.size());
  welded_.reserve(soup.points.size());
  for (const Vec3d& point : soup.points) welded_.push_back(welder.index_of(point));
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

TriangleList::TriangleList(const SoupCorners& corners) {
  const auto count = static_cast<std::uint32_t>(corners.soup().triangles.size());
  reserve(count);
  for (std::uint32_t id = 0; id < count; ++id) add(corners, id);
}

TriangleList::TriangleList(const SoupCorners& corners, std::span<const std::uint32_t> among) {
  reserve(among.size());
  std::vector<char> seen(corners.soup().triangles.size(), 0);
  for (const std::uint32_t id : among) {
    if (seen[id] == 0) add(corners, id);
    seen[id] = 1;
  }
}

void TriangleList::reserve(std::size_t count) {
  triangles_.reserve(count);
  boxes_.reserve(count);
  ids_.reserve(count);
}

void TriangleList::add(const SoupCorners& corners, std::uint32_t id) {
  CornerTriangle triangle;
  switch (corners.fetch(id, triangle)) {
    case Fetched::usable:
      triangles_.push_back(triangle);
      boxes_.push_back(box_of(corners.soup(), id));
      ids_.push_back(id);
      break;
    case Fetched::degenerate:
      ++degenerate_;
      break;
    case Fetched::not_finite:
      ++not_finite_;
      break;
  }
}

}  // namespace meshrepair::internal
