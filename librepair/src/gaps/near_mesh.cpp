// SPDX-License-Identifier: MIT
#include "near_mesh.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <base/ids.h>
#include <mesh/weld_points.h>

#include "face_pieces.h"

namespace meshrepair::internal {

double share_along(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d way = b - a;
  const double squared = way.squaredNorm();
  return squared > 0 ? way.dot(p - a) / squared : 0;
}

NearMesh::NearMesh(const TriangleSoup& soup)
    : at(soup.points), name(first_in_place(soup.points)), inner(soup.triangles.size()) {
  corners.reserve(soup.triangles.size());
  for (const auto& t : soup.triangles) corners.push_back({name[t[0]], name[t[1]], name[t[2]]});
}

std::vector<std::uint32_t> NearMesh::along(std::uint32_t from, std::uint32_t to) const {
  std::vector<std::uint32_t> points = {from};
  const std::uint32_t e = edge_between(from, to);
  if (e == kNone) return points;
  const Edge& edge = edges[e];
  std::vector<std::pair<double, std::uint32_t>> order;
  for (const std::uint32_t p : edge.inner) {
    order.emplace_back(share_along(at[p], at[edge.ends[0]], at[edge.ends[1]]), p);
  }
  std::sort(order.begin(), order.end());
  if (from != edge.ends[0]) std::reverse(order.begin(), order.end());
  for (const auto& [share, p] : order) points.push_back(p);
  return points;
}

std::uint32_t NearMesh::edge_between(std::uint32_t a, std::uint32_t b) const {
  const EdgeEnds ends = ascending(a, b);
  const auto found = std::lower_bound(edges.begin(), edges.end(), ends,
                                      [](const Edge& e, const EdgeEnds& x) { return e.ends < x; });
  return found != edges.end() && found->ends == ends
             ? static_cast<std::uint32_t>(found - edges.begin())
             : kNone;
}

namespace {

// Of each triangle the pieces of edges between its points that are not on its outline.
std::vector<std::vector<EdgeEnds>> edges_inside(
    const NearMesh& mesh, const std::vector<std::vector<std::uint32_t>>& outlines) {
  std::vector<std::vector<std::uint32_t>> triangles_at(mesh.at.size());
  for (std::uint32_t t = 0; t < outlines.size(); ++t) {
    if (outlines[t].size() == 3 && mesh.inner[t].empty() &&
        mesh.edge_between(mesh.corners[t][0], mesh.corners[t][1]) == kNone)
      continue;
    for (const std::vector<std::uint32_t>* list : {&outlines[t], &mesh.inner[t]}) {
      for (const std::uint32_t p : *list) {
        if (triangles_at[p].empty() || triangles_at[p].back() != t) triangles_at[p].push_back(t);
      }
    }
  }
  const auto are_on_one_side = [&](std::uint32_t t, std::uint32_t a, std::uint32_t b) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<std::uint32_t> side =
          mesh.along(mesh.corners[t][k], mesh.corners[t][(k + 1) % 3]);
      side.push_back(mesh.corners[t][(k + 1) % 3]);
      if (has(side, a) && has(side, b)) return true;
    }
    return false;
  };
  std::vector<std::vector<EdgeEnds>> inside(outlines.size());
  for (const NearMesh::Edge& edge : mesh.edges) {
    std::vector<std::uint32_t> points = mesh.along(edge.ends[0], edge.ends[1]);
    points.push_back(edge.ends[1]);
    for (std::size_t i = 1; i < points.size(); ++i) {
      const std::uint32_t a = points[i - 1], b = points[i];
      std::vector<std::uint32_t> both;
      std::set_intersection(triangles_at[a].begin(), triangles_at[a].end(), triangles_at[b].begin(),
                            triangles_at[b].end(), std::back_inserter(both));
      for (const std::uint32_t t : both) {
        if (!are_on_one_side(t, a, b)) inside[t].push_back(ascending(a, b));
      }
    }
  }
  for (std::vector<EdgeEnds>& list : inside) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return inside;
}

}  // namespace

JoinedSoup cut_near_mesh(const TriangleSoup& soup, const NearMesh& mesh, JoinGapsReport& report,
                         CancelCheck& check) {
  std::vector<std::vector<std::uint32_t>> outlines(mesh.corners.size());
  for (std::uint32_t t = 0; t < mesh.corners.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::vector<std::uint32_t> side =
          mesh.along(mesh.corners[t][k], mesh.corners[t][(k + 1) % 3]);
      outlines[t].insert(outlines[t].end(), side.begin(), side.end());
    }
  }
  const std::vector<std::vector<EdgeEnds>> inside = edges_inside(mesh, outlines);
  JoinedSoup joined;
  joined.soup.points = mesh.at;
  FacePieces faces(joined.soup.points);
  for (std::uint32_t t = 0; t < mesh.corners.size(); ++t) {
    check.tick();
    std::vector<IndexTriangle> pieces;
    if (outlines[t].size() == 3 && inside[t].empty()) {
      pieces = {mesh.corners[t]};
    } else {
      const auto& c = soup.triangles[t];
      const Vec3d& a = soup.points[c[0]];
      const Vec3d normal = (soup.points[c[1]] - a).cross(soup.points[c[2]] - a);
      (void)faces.cut(outlines[t], inside[t], normal, pieces);
    }
    for (const IndexTriangle& piece : pieces) {
      joined.soup.triangles.push_back(piece);
      joined.source.push_back(t);
    }
  }
  for (std::size_t p = 0; p < soup.points.size(); ++p) {
    const double move = (mesh.at[mesh.name[p]] - soup.points[p]).norm();
    if (move > report.farthest_move) report.farthest_move = move;
    const bool is_first = mesh.name[p] == p || soup.points[p] == soup.points[mesh.name[p]];
    report.joined_points += is_first ? 0 : 1;
  }
  report.new_points = mesh.at.size() - soup.points.size();
  return joined;
}

}  // namespace meshrepair::internal
