// Long thin triangles, as those between the tip of a cone and its rim, have boxes that meet nearly
// all others. So space is cut in halves instead, and each half gets the parts of triangles in it,
// with boxes of these parts alone, until few triangles are left, or only such as have a hub in
// common. The boxes are what rounding leaves of them and a margin that is far larger than its
// errors; a pair is decided exactly. It may be met in several places: what is found is found once.
#include "spatial_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include <bsp/assert.h>
#include <bsp/error.h>

#include "triangle_hubs.h"

namespace meshrepair::internal {
namespace {

constexpr std::size_t kSamples = 256;
constexpr std::size_t kTestsPerSample = 32;
// On a common mesh it is about 15.
constexpr std::size_t kManyNeighbours = 256;
constexpr std::size_t kHitsAreRare = 16;

// Up to here all pairs are tested.
constexpr std::size_t kFew = 16;
// Cuts in a row that took few triangles away: what is left lies together in one place.
constexpr int kMostVainCuts = 9;
constexpr std::size_t kCellsPerQuestion = 256;
// For each triangle: about 70 clipped parts are enough to tell the sides of a cone of 100,000
// apart, while thin triangles that pass each other closely, askew to the axes, fall into ever more.
constexpr std::size_t kMostWork = 256;

// Coordinates are scaled to at most 1. A point that two triangles have in common is in one of the
// two halves of each cell that it is in, and this far at least from its walls, but for rounding.
// What rounding in clip() can lose of a triangle lies within a few 2^-53 of a wall, so that the
// point is kept in both triangles' parts.
constexpr double kMargin = 0x1p-42;

bool have_one_hub(std::span<const std::uint32_t> hubs, std::uint32_t a, std::uint32_t b) {
  return hubs[a] != kNoHub && hubs[a] == hubs[b];
}

template <class Visit>
void visit_neighbours(const BoxTree& tree, std::span<const Box> boxes, const Box& box,
                      Visit visit) {
  std::vector<std::uint32_t> stack(1, 0);
  while (!stack.empty()) {
    const std::uint32_t n = stack.back();
    stack.pop_back();
    const BoxNode& node = tree.nodes()[n];
    if (!node.box.meets(box)) continue;
    if (node.is_leaf()) {
      for (const std::uint32_t item : tree.order().subspan(node.first, node.count)) {
        if (boxes[item].meets(box)) visit(item);
      }
    } else {
      stack.push_back(node.right);
      stack.push_back(n + 1);
    }
  }
}

void widen(Box& box) {
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] -= kMargin;
    box.high[k] += kMargin;
  }
}

// The part of a triangle in a box: a convex polygon of at most nine corners.
class ClippedTriangle {
 public:
  ClippedTriangle(const std::array<Vec3d, 3>& corners, const Box& box) {
    std::copy(corners.begin(), corners.end(), corners_.begin());
    for (int axis = 0; axis < 3 && count_ > 0; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      clip(axis, box.low[k], 1);
      clip(axis, box.high[k], -1);
    }
  }

  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] Box box() const {
    Box box;
    for (std::size_t i = 0; i < count_; ++i) box.add(corners_[i]);
    widen(box);
    return box;
  }

 private:
  // Keeps what is at `limit` or beyond, in the direction of `sign`.
  void clip(int axis, double limit, double sign) {
    const auto height = [&](const Vec3d& p) { return sign * (p[axis] - limit); };
    const auto below = [&](const Vec3d& p) { return height(p) < 0; };
    if (std::none_of(corners_.begin(), corners_.begin() + count_, below)) return;
    std::array<Vec3d, kMostCorners> kept;
    std::size_t kept_count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const Vec3d& a = corners_[i];
      const Vec3d& b = corners_[i + 1 == count_ ? 0 : i + 1];
      MESHREPAIR_ASSERT(kept_count + 2 <= kMostCorners);
      if (!below(a)) kept[kept_count++] = a;
      if (below(a) == below(b)) continue;
      const double share = height(a) / (height(a) - height(b));
      kept[kept_count] = a + share * (b - a);
      kept[kept_count++][axis] = limit;
    }
    corners_ = kept;
    count_ = kept_count;
  }

  // Each of six planes adds one at most; one more than that is room for what rounding could do.
  static constexpr std::size_t kMostCorners = 16;
  std::array<Vec3d, kMostCorners> corners_;
  std::size_t count_ = 3;
};

class SpatialComparison {
 public:
  SpatialComparison(std::span<const CornerTriangle> triangles, std::span<const std::uint32_t> hubs,
                    ProgressObserver* progress)
      : triangles_(triangles), hubs_(hubs), progress_(progress) {
    double largest = 0;
    for (const CornerTriangle& t : triangles) {
      for (const Vec3d& p : t.at) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    }
    int exponent = 0;
    (void)std::frexp(largest, &exponent);
    scaled_.reserve(triangles.size());
    for (const CornerTriangle& t : triangles) {
      std::array<Vec3d, 3> corners = t.at;
      for (Vec3d& p : corners) {
        for (double& x : p) x = std::ldexp(x, -exponent);
      }
      scaled_.push_back(corners);
    }
  }

  std::optional<std::vector<MeetingPair>> run() {
    std::vector<Part> parts;
    parts.reserve(scaled_.size());
    for (std::uint32_t i = 0; i < scaled_.size(); ++i) {
      Box box;
      for (const Vec3d& p : scaled_[i]) box.add(p);
      widen(box);
      parts.push_back({i, box});
    }
    cells_.push_back({std::move(parts), 0});
    while (!cells_.empty()) {
      const Cell cell = std::move(cells_.back());
      cells_.pop_back();
      ask();
      if (work_ > kMostWork * scaled_.size()) return std::nullopt;
      look_at(cell);
    }
    keep_once();
    return std::move(found_);
  }

 private:
  struct Part {
    std::uint32_t triangle;
    Box box;  // of what of it is in the cell
  };
  struct Cell {
    std::vector<Part> parts;
    int vain_cuts;
  };

  void ask() {
    if (++steps_ % kCellsPerQuestion != 0 || progress_ == nullptr) return;
    if (progress_->cancelled()) throw Cancelled();
  }

  void look_at(const Cell& cell) {
    if (cell.parts.size() < 2 || all_have_one_hub(cell.parts)) return;
    if (cell.parts.size() <= kFew || cell.vain_cuts >= kMostVainCuts) {
      // Many in one place count before they are compared, so that too many never are.
      if (cell.parts.size() > kFew) work_ += cell.parts.size() * cell.parts.size() / 2;
      if (work_ <= kMostWork * scaled_.size()) compare_all(cell.parts);
    } else {
      halve(cell);
    }
  }

  [[nodiscard]] bool all_have_one_hub(const std::vector<Part>& parts) const {
    return std::all_of(parts.begin() + 1, parts.end(), [&](const Part& part) {
      return have_one_hub(hubs_, parts[0].triangle, part.triangle);
    });
  }

  void halve(const Cell& cell) {
    Box whole;
    for (const Part& part : cell.parts) whole.add(part.box);
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (whole.high[k] - whole.low[k] > whole.high[axis] - whole.low[axis]) axis = k;
    }
    const double middle = 0.5 * (whole.low[axis] + whole.high[axis]);
    Box lower = whole, upper = whole;
    lower.high[axis] = middle + kMargin;
    upper.low[axis] = middle - kMargin;
    for (const Box& half : {lower, upper}) {
      std::vector<Part> parts;
      for (const Part& part : cell.parts) {
        if (!part.box.meets(half)) continue;
        ++work_;
        const ClippedTriangle clipped(scaled_[part.triangle], half);
        if (!clipped.empty()) parts.push_back({part.triangle, clipped.box()});
      }
      const bool in_vain = 8 * parts.size() > 7 * cell.parts.size();
      cells_.push_back({std::move(parts), in_vain ? cell.vain_cuts + 1 : 0});
    }
  }

  void compare_all(const std::vector<Part>& parts) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      ask();
      for (std::size_t j = i + 1; j < parts.size(); ++j) {
        if (!parts[i].box.meets(parts[j].box)) continue;
        const auto [a, b] = std::minmax(parts[i].triangle, parts[j].triangle);
        if (have_one_hub(hubs_, a, b)) continue;
        const Meeting meeting = meeting_of(triangles_[a], triangles_[b]);
        if (meeting != Meeting::apart) add({a, b, meeting});
      }
    }
  }

  void add(const MeetingPair& pair) {
    found_.push_back(pair);
    if (found_.size() >= 2 * once_ + 4096) keep_once();
  }

  void keep_once() {
    const auto key = [](const MeetingPair& pair) { return std::tie(pair.a, pair.b); };
    std::sort(found_.begin(), found_.end(),
              [&](const MeetingPair& x, const MeetingPair& y) { return key(x) < key(y); });
    found_.erase(
        std::unique(found_.begin(), found_.end(),
                    [&](const MeetingPair& x, const MeetingPair& y) { return key(x) == key(y); }),
        found_.end());
    once_ = found_.size();
  }

  std::span<const CornerTriangle> triangles_;
  std::span<const std::uint32_t> hubs_;
  ProgressObserver* progress_;
  std::vector<std::array<Vec3d, 3>> scaled_;
  std::vector<Cell> cells_;
  std::vector<MeetingPair> found_;
  std::size_t once_ = 0;  // how many of them are known to be there once
  std::size_t steps_ = 0;
  std::size_t work_ = 0;  // parts clipped, and pairs tested
};

}  // namespace

bool boxes_tell_little(std::span<const CornerTriangle> triangles, std::span<const Box> boxes,
                       std::span<const std::uint32_t> hubs, const BoxTree& tree) {
  if (triangles.size() < kSamples * kManyNeighbours / 16) return false;
  std::size_t neighbours = 0, tests = 0, hits = 0;
  for (std::size_t k = 0; k < kSamples; ++k) {
    const auto sample = static_cast<std::uint32_t>(k * triangles.size() / kSamples);
    std::size_t own_tests = 0;
    visit_neighbours(tree, boxes, boxes[sample], [&](std::uint32_t other) {
      if (other == sample || have_one_hub(hubs, sample, other)) return;
      ++neighbours;
      if (++own_tests > kTestsPerSample) return;
      ++tests;
      hits += meeting_of(triangles[sample], triangles[other]) != Meeting::apart;
    });
  }
  return neighbours > kSamples * kManyNeighbours && hits * kHitsAreRare < tests;
}

std::optional<std::vector<MeetingPair>> compare_in_space(std::span<const CornerTriangle> triangles,
                                                         std::span<const std::uint32_t> hubs,
                                                         ProgressObserver* progress) {
  return SpatialComparison(triangles, hubs, progress).run();
}

}  // namespace meshrepair::internal
