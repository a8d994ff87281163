// SPDX-License-Identifier: MIT
// Which parts are to be turned round?
//
// Idea: a shell that faces inward is the wall of a cavity, or inside out. Doubt arises only where a
// winding number is negative (something faces inward that nothing surrounds), or where the
// triangles of a shell do not tell which way is out. Then all shells are turned outward first,
// which an exact volume tells, and the winding numbers W of that say how shells lie in each other.
// The cells with W > 1/2, and what they seal off, fall into blobs that have nothing to do with each
// other. In each blob:
//
// - If no shell is doubtful and no winding number, as given, is negative: as given.
// - If none is doubtful and none is positive: all of it is inside out and is turned.
// - Else the shells that face outward by their own word stay so. Each of the others is the wall of
//   a cavity if the solid of the parts around it, decided before it, encloses most of its area; if
//   it does not lie in any other shell, is hardly more inside than outside or lies in the cavity of
//   one, it faces outward.
//
// Each depth of nesting costs a pass over the cells (or the solver, where triangles are missing).
#include "turn_parts.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <base/disjoint_sets.h>
#include <base/ids.h>

#include "winding_field.h"

namespace meshrepair::internal {
namespace {

// A shell that pokes out of the solid around it with no more than this share of its area lies in it
// all the same: the wall of a cavity that comes through somewhere. Its triangles say nothing ...
constexpr double kPokingShare = 0.05;

// ... or that it is such a wall: then nearly twice as much of it has to lie inside as outside. Two
// rough surfaces of one body have about half of their area outside each other, as have the
// boundaries of two equal bodies that overlap, at least: 1/2, however little they are apart. Those
// of a rough wall that is as thick as it is rough have up to 1/5. Meshes on whole numbers have just
// a third at times, where the last bits of a sum would decide.
constexpr double kPokingShareOfInward = 0.34;

// Between these shares the other reading is nearly as likely.
constexpr double kSurelyWall = 0.2;
constexpr double kSurelyBody = 0.5;

// A part that does not tell its way out is no wall of a cavity in what holes make up by more than
// this share of its area: a ring with lids is no vessel for its hub.
constexpr double kMostMadeUp = 0.5;

bool in_doubt(const Orientation& orientation, const std::vector<double>& w) {
  return std::any_of(w.begin(), w.end(), [](double x) { return x < -0.5; }) ||
         std::any_of(orientation.parts.begin(), orientation.parts.end(),
                     [](const OrientedPart& p) { return p.shell && !p.believed; });
}

class PartTurner {
 public:
  PartTurner(const CellGraph& graph, const Orientation& orientation, const InsideOptions& options,
             InsideReport& report)
      : graph_(graph),
        orientation_(orientation),
        parts_(orientation.parts),
        options_(options),
        report_(report),
        sign_(parts_.size(), 1) {}

  std::vector<double> run(const std::vector<double>& given) {
    list_links_of_parts();
    std::vector<std::int8_t> outward(parts_.size(), 1);
    for (std::size_t p = 0; p < parts_.size(); ++p) outward[p] = parts_[p].outward < 0 ? -1 : 1;
    sign_ = outward;
    const std::vector<double> w_outward = field();
    find_blobs(w_outward);
    judge_blobs(given);
    for (std::uint32_t p = 0; p < parts_.size(); ++p) {
      if (!is_candidate(p)) sign_[p] = part_is_reversed(p) ? -1 : 1;
    }
    decide_candidates(w_outward);
    count_turned(outward);
    return field();
  }

 private:
  struct Blob {
    bool positive = false, negative = false, doubtful = false;
    double area = 0, made_up = 0;  // of the parts that no other encloses
    [[nodiscard]] bool reversed() const { return negative && !positive && !doubtful; }
    [[nodiscard]] bool mixed() const { return negative && !reversed(); }
  };

  struct Candidate {
    double depth;
    std::uint32_t part;
    double outside;  // the share of its area, among all shells
  };

  std::vector<double> field() {
    IdVector<TriangleId, std::int32_t> winding = orientation_.winding;
    for (TriangleId t(0u); t < winding.end_id(); ++t.value) {
      winding[t] *= sign_[orientation_.part_of[t]];
    }
    graph_.set_windings(winding);
    return winding_field(graph_, options_.solve, report_);
  }

  void list_links_of_parts() {
    first_link_.assign(parts_.size() + 1, 0);
    const auto& links = graph_.links();
    for (const Link& link : links) {
      if (link.opaque()) ++first_link_[orientation_.part_of[link.triangle] + 1];
    }
    for (std::size_t p = 1; p < first_link_.size(); ++p) first_link_[p] += first_link_[p - 1];
    part_links_.resize(first_link_.back());
    std::vector<std::uint32_t> filled(first_link_.begin(), first_link_.end() - 1);
    for (std::uint32_t l = 0; l < links.size(); ++l) {
      if (!links[l].opaque()) continue;
      part_links_[filled[orientation_.part_of[links[l].triangle]]++] = l;
    }
  }

  [[nodiscard]] std::span<const std::uint32_t> links_of_part(std::uint32_t p) const {
    return {part_links_.data() + first_link_[p], first_link_[p + 1] - first_link_[p]};
  }

  // The cells that infinity is not reached from through w < 1/2, in connected regions. Regions that
  // one part touches are one blob.
  void find_blobs(const std::vector<double>& w) {
    blob_of_.assign(graph_.cells(), kNone);
    std::vector<char> outside(graph_.cells(), 0);
    std::vector<CellId> queue;
    const auto grow = [&](auto joins, auto mark) {
      while (!queue.empty()) {
        const CellId cell = queue.back();
        queue.pop_back();
        for (const std::uint32_t l : graph_.links_of(cell)) {
          const CellId next = other_end(graph_.links()[l], cell);
          if (!joins(next)) continue;
          mark(next);
          queue.push_back(next);
        }
      }
    };
    for (CellId c(0u); c.index() < graph_.cells(); ++c.value) {
      if (!graph_.unbounded(c)) continue;
      outside[c.index()] = 1;
      queue.push_back(c);
    }
    grow([&](CellId c) { return outside[c.index()] == 0 && w[c.index()] < 0.5; },
         [&](CellId c) { outside[c.index()] = 1; });
    std::uint32_t count = 0;
    for (CellId c(0u); c.index() < graph_.cells(); ++c.value) {
      if (outside[c.index()] != 0 || blob_of_[c.index()] != kNone) continue;
      blob_of_[c.index()] = count;
      queue.push_back(c);
      grow([&](CellId d) { return outside[d.index()] == 0 && blob_of_[d.index()] == kNone; },
           [&](CellId d) { blob_of_[d.index()] = count; });
      ++count;
    }
    join_blobs(count);
  }

  void join_blobs(std::uint32_t count) {
    DisjointSets sets(count);
    part_blob_.assign(parts_.size(), kNone);
    for (std::uint32_t p = 0; p < parts_.size(); ++p) {
      for (const std::uint32_t l : links_of_part(p)) {
        const Link& link = graph_.links()[l];
        for (const CellId c : {link.below, link.above}) {
          const std::uint32_t blob = blob_of_[c.index()];
          if (blob == kNone) continue;
          if (part_blob_[p] == kNone) part_blob_[p] = blob;
          sets.join(part_blob_[p], blob);
        }
      }
    }
    for (std::uint32_t& blob : part_blob_) blob = blob == kNone ? kNone : sets.root(blob);
    for (std::uint32_t& blob : blob_of_) blob = blob == kNone ? kNone : sets.root(blob);
    blobs_.assign(count, {});
  }

  void judge_blobs(const std::vector<double>& given) {
    for (std::size_t c = 0; c < given.size(); ++c) {
      if (blob_of_[c] == kNone) continue;
      blobs_[blob_of_[c]].positive |= given[c] > 0.5;
      blobs_[blob_of_[c]].negative |= given[c] < -0.5;
    }
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (part_blob_[p] == kNone) continue;
      blobs_[part_blob_[p]].doubtful |= parts_[p].shell && !parts_[p].believed;
    }
  }

  [[nodiscard]] bool part_is_reversed(std::uint32_t p) const {
    return part_blob_[p] != kNone && blobs_[part_blob_[p]].reversed();
  }

  [[nodiscard]] bool is_candidate(std::uint32_t p) const {
    const OrientedPart& part = parts_[p];
    if (!part.shell || part.outward == 0 || part_blob_[p] == kNone) return false;
    const Blob& blob = blobs_[part_blob_[p]];
    return !part.believed || (part.outward < 0 && (blob.doubtful || blob.mixed()));
  }

  // The share of the part's area whose outer side has w < 1/2, while the part faces outward.
  [[nodiscard]] double share_outside(std::uint32_t p, const std::vector<double>& w) const {
    double all = 0, outside = 0;
    for (const std::uint32_t l : links_of_part(p)) {
      const Link& link = graph_.links()[l];
      all += link.area;
      if (std::min(w[link.below.index()], w[link.above.index()]) < 0.5) outside += link.area;
    }
    return all > 0 ? outside / all : 1;
  }

  // How many shells the part lies in.
  [[nodiscard]] double depth_of(std::uint32_t p, const std::vector<double>& w) const {
    double depth = std::numeric_limits<double>::max();
    for (const std::uint32_t l : links_of_part(p)) {
      const Link& link = graph_.links()[l];
      const double outer = std::min(w[link.below.index()], w[link.above.index()]);
      if (outer >= 0.5) depth = std::min(depth, std::round(outer));
    }
    return depth;
  }

  [[nodiscard]] double most_outside(std::uint32_t p) const {
    return parts_[p].believed ? kPokingShareOfInward : kPokingShare;
  }

  void measure_made_up(std::uint32_t p) {
    if (part_blob_[p] == kNone) return;
    Blob& blob = blobs_[part_blob_[p]];
    for (const std::uint32_t l : links_of_part(p)) {
      const Link& link = graph_.links()[l];
      blob.area += link.area;
      if (!link.given) blob.made_up += link.area;
    }
  }

  [[nodiscard]] bool may_be_wall(std::uint32_t p) const {
    const Blob& blob = blobs_[part_blob_[p]];
    return parts_[p].believed || blob.made_up <= kMostMadeUp * blob.area;
  }

  // Those that others enclose, from the outermost on.
  std::vector<Candidate> enclosed_candidates(const std::vector<double>& w_outward) {
    std::vector<Candidate> enclosed;
    for (std::uint32_t p = 0; p < parts_.size(); ++p) {
      const double outside = is_candidate(p) ? share_outside(p, w_outward) : 1;
      if (outside > most_outside(p)) measure_made_up(p);
      if (!is_candidate(p)) continue;
      if (outside <= most_outside(p)) {
        enclosed.push_back({depth_of(p, w_outward), p, outside});
      } else if (parts_[p].believed && outside < kSurelyBody) {
        report_.other = InsideRule::winding;
      }
    }
    std::erase_if(enclosed, [this](const Candidate& c) { return !may_be_wall(c.part); });
    std::stable_sort(enclosed.begin(), enclosed.end(),
                     [](const Candidate& a, const Candidate& b) { return a.depth < b.depth; });
    return enclosed;
  }

  void decide_candidates(const std::vector<double>& w_outward) {
    const std::vector<Candidate> enclosed = enclosed_candidates(w_outward);
    for (std::size_t first = 0; first < enclosed.size();) {
      const std::vector<double> w = field();
      std::vector<Candidate> walls;
      std::size_t last = first;
      for (; last < enclosed.size() && enclosed[last].depth == enclosed[first].depth; ++last) {
        if (share_outside(enclosed[last].part, w) < 0.5) walls.push_back(enclosed[last]);
      }
      for (const Candidate& wall : walls) make_wall(wall);
      first = last;
    }
  }

  void make_wall(const Candidate& wall) {
    sign_[wall.part] = static_cast<std::int8_t>(-sign_[wall.part]);
    if (wall.outside == 0) return;
    ++report_.poking_walls;
    report_.poking_share = std::max(report_.poking_share, wall.outside);
    if (wall.outside > kSurelyWall) report_.other = InsideRule::solidity;
  }

  void count_turned(const std::vector<std::int8_t>& outward) {
    for (std::uint32_t p = 0; p < parts_.size(); ++p) {
      if (parts_[p].believed) {
        report_.turned_parts += sign_[p] < 0;
      } else if (parts_[p].shell) {
        ++report_.doubtful_parts;
        report_.cavity_walls += sign_[p] != outward[p];
      }
    }
  }

  CellGraph graph_;
  const Orientation& orientation_;
  const std::vector<OrientedPart>& parts_;
  const InsideOptions& options_;
  InsideReport& report_;
  std::vector<std::int8_t> sign_;  // of each part, against its orientation
  std::vector<std::uint32_t> first_link_, part_links_;
  std::vector<std::uint32_t> blob_of_;    // of each cell
  std::vector<std::uint32_t> part_blob_;  // of each part
  std::vector<Blob> blobs_;
};

}  // namespace

std::vector<double> turn_parts(const CellGraph& graph, const Orientation& orientation,
                               std::vector<double> w, const InsideOptions& options,
                               InsideReport& report) {
  if (!in_doubt(orientation, w)) return w;
  return PartTurner(graph, orientation, options, report).run(w);
}

}  // namespace meshrepair::internal
