// SPDX-License-Identifier: MIT
#include "walls/tetrahedra.h"

#include <algorithm>
#include <cmath>

namespace meshrepair::internal {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};
// The corners of the cubes lie beside planes of symmetry: a distance that is the same at many of
// them would put many points of the walls onto them. Shares of a cube, without a meaning.
constexpr std::array<double, 3> kBeside = {0.377, 0.291, 0.433};

bool has(const std::array<std::uint32_t, 4>& corners, std::uint32_t point) {
  return std::find(corners.begin(), corners.end(), point) != corners.end();
}

}  // namespace

Tetrahedra::Tetrahedra(const Box& box, double edge) {
  std::array<std::size_t, 3> count{};
  for (std::size_t k = 0; k < 3; ++k) {
    count[k] = static_cast<std::size_t>(std::ceil((box.high[k] - box.low[k]) / edge)) + 1;
  }
  for (std::size_t z = 0; z <= count[2]; ++z) {
    for (std::size_t y = 0; y <= count[1]; ++y) {
      for (std::size_t x = 0; x <= count[0]; ++x) {
        const std::array<std::size_t, 3> at = {x, y, z};
        Vec3d point;
        for (std::size_t k = 0; k < 3; ++k) {
          point[static_cast<Eigen::Index>(k)] =
              box.low[k] + (static_cast<double>(at[k]) - kBeside[k]) * edge;
        }
        const auto number = static_cast<std::uint32_t>(points_.size());
        points_.push_back(point);
        ends_.push_back({number, number});
      }
    }
  }
  heads_.assign(points_.size(), kNone);
  add_cubes(count);
}

void Tetrahedra::add_cubes(const std::array<std::size_t, 3>& count) {
  const std::array<std::size_t, 3> stride = {1, count[0] + 1, (count[0] + 1) * (count[1] + 1)};
  for (std::size_t z = 0; z < count[2]; ++z) {
    for (std::size_t y = 0; y < count[1]; ++y) {
      for (std::size_t x = 0; x < count[0]; ++x) {
        std::array<std::size_t, 3> order = {0, 1, 2};
        do {  // each way from the one end of the diagonal to the other
          Cell cell;
          std::size_t at = x * stride[0] + y * stride[1] + z * stride[2];
          cell.corners[0] = static_cast<std::uint32_t>(at);
          for (std::size_t i = 0; i < 3; ++i) {
            at += stride[order[i]];
            cell.corners[i + 1] = static_cast<std::uint32_t>(at);
          }
          add_cell(cell);
        } while (std::next_permutation(order.begin(), order.end()));
      }
    }
  }
}

void Tetrahedra::add_cell(const Cell& cell) {
  const auto number = static_cast<std::uint32_t>(cells_.size());
  cells_.push_back(cell);
  for (const std::uint32_t point : cell.corners) note(number, point);
  changed_.push_back(number);
}

void Tetrahedra::note(std::uint32_t cell, std::uint32_t point) {
  links_.push_back({cell, heads_[point]});
  heads_[point] = static_cast<std::uint32_t>(links_.size() - 1);
}

std::array<std::uint32_t, 2> Tetrahedra::edge_to_cut(std::uint32_t cell) const {
  const Cell& one = cells_[cell];
  const std::uint32_t a = one.corners[0];
  const std::uint32_t b = one.corners[static_cast<std::size_t>(3 - one.level % 3)];
  return {std::min(a, b), std::max(a, b)};
}

// Links to cells that lost the point are taken out on the way.
std::vector<std::uint32_t> Tetrahedra::around(std::uint32_t a, std::uint32_t b) {
  std::vector<std::uint32_t> found;
  std::uint32_t* link = &heads_[a];
  while (*link != kNone) {
    Link& at = links_[*link];
    const auto& corners = cells_[at.cell].corners;
    if (!has(corners, a)) {
      *link = at.next;
      continue;
    }
    if (has(corners, b)) found.push_back(at.cell);
    link = &at.next;
  }
  return found;
}

void Tetrahedra::bisect(std::uint32_t tetrahedron) {
  const std::array<std::uint32_t, 2> edge = edge_to_cut(tetrahedron);
  std::vector<std::uint32_t> cells = around(edge[0], edge[1]);
  for (;;) {
    const auto other = std::find_if(cells.begin(), cells.end(),
                                    [&](std::uint32_t cell) { return edge_to_cut(cell) != edge; });
    if (other == cells.end()) break;
    bisect(*other);
    cells = around(edge[0], edge[1]);
  }
  const auto middle = static_cast<std::uint32_t>(points_.size());
  points_.emplace_back(0.5 * points_[edge[0]] + 0.5 * points_[edge[1]]);
  ends_.push_back(edge);
  heads_.push_back(kNone);
  std::sort(cells.begin(), cells.end());
  for (const std::uint32_t cell : cells) cut(cell, middle);
}

void Tetrahedra::cut(std::uint32_t cell, std::uint32_t middle) {
  const Cell whole = cells_[cell];
  const auto tag = static_cast<std::size_t>(3 - whole.level % 3);
  Cell& first = cells_[cell];
  first.corners[tag] = middle;
  ++first.level;
  note(cell, middle);
  changed_.push_back(cell);
  Cell second = whole;
  for (std::size_t i = 0; i < tag; ++i) second.corners[i] = whole.corners[i + 1];
  second.corners[tag] = middle;
  ++second.level;
  add_cell(second);
}

std::vector<std::uint32_t> Tetrahedra::take_changed() {
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  return std::exchange(changed_, {});
}

}  // namespace meshrepair::internal
