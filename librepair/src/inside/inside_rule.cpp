// SPDX-License-Identifier: MIT
// Which cells are solid, by the rule that was asked for:
//
// - winding: the winding number of a cell, from a walk over all walls; where walls contradict each
//   other, from least squares.
// - parity: whether an odd number of walls is between the cell and the outside; where walls
//   contradict each other, solidity, by the linear system of T. Murali and T. Funkhouser
//   (Consistent solid and boundary representations from arbitrary polygonal data, 1997).
// - solidity: the same, and then all that a flood from infinity does not reach (WM 6.2).
//
// The automatic rule believes the orientation where it can be trusted: winding numbers near
// integers, and few walls that contradict them. Then parts that face the wrong way are turned
// (turn_parts.h). Where the walk met a contradiction, solidity is asked, too, and both are compared
// by what Murali and Funkhouser keep small: the area of boundary that no triangle covers, and of
// triangles that the solid leaves unexplained. Solidity has to be clearly better, as what it adds
// are often slivers. The other rule is named in the report where it comes near and much hangs on
// it.
#include <algorithm>
#include <cmath>
#include <utility>

#include <repair/inside_rule.h>
#include <repair/walk.h>

#include "flood.h"
#include "outer_pockets.h"
#include "turn_parts.h"
#include "voids.h"
#include "winding_field.h"

namespace meshrepair {
namespace {

std::string parts(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " part" : " parts");
}

// Solidity has to explain the mesh clearly better than the winding numbers do, by this factor: what
// it adds are often slivers.
constexpr double kClearlyBetter = 0.95;

// Within this factor the other rule is named, if more than this share of the volume hangs on it.
constexpr double kNearlyAsGood = 1.1;
constexpr double kMuchOfVolume = 0.01;

class InsideDecider {
 public:
  InsideDecider(const CellGraph& graph, const Orientation& orientation,
                const InsideOptions& options, InsideReport& report)
      : graph_(graph), orientation_(orientation), options_(options), report_(report) {}

  CellLabels run() {
    report_.asked = report_.used = options_.rule;
    CellLabels labels = by_rule();
    if (options_.cavities == Cavities::fill && report_.used == InsideRule::winding) {
      report_.filled_voids = internal::fill_voids(graph_, labels.solid, options_.solve.progress);
    }
    if (report_.reason.empty()) report_.reason = "asked for";
    report_.solid_cells =
        static_cast<std::size_t>(std::count(labels.solid.begin(), labels.solid.end(), 1));
    return labels;
  }

 private:
  CellLabels by_rule() {
    switch (options_.rule) {
      case InsideRule::parity:
        // Filled, parity is solidity, and overlaps are no voids there.
        if (options_.cavities == Cavities::fill) return by_solidity(Cavities::fill);
        return by_parity();
      case InsideRule::solidity:
        return by_solidity(Cavities::fill);
      case InsideRule::winding:
        return by_winding_as_given();
      case InsideRule::automatic:
        break;
    }
    return by_trust();
  }

  std::vector<double> solidity() {
    const Walk walk = walk_parity(graph_, options_.solve.progress);
    report_.exact = walk.consistent();
    report_.contradictions = walk.contradictions;
    std::vector<double> s(graph_.cells());
    for (std::size_t i = 0; i < s.size(); ++i) s[i] = 2.0 * walk.value[i] - 1.0;
    return walk.consistent() ? s : solve_solidity(graph_, options_.solve, report_.solve, s);
  }

  CellLabels by_parity() {
    CellLabels labels;
    for (const double s : solidity()) {
      labels.solid.push_back(s > 0 ? 1 : 0);
      labels.confidence.push_back(static_cast<float>(std::abs(s)));
    }
    return labels;
  }

  CellLabels by_solidity(Cavities cavities) {
    CellLabels labels = by_parity();
    std::vector<char> empty(labels.solid.size());
    for (std::size_t i = 0; i < empty.size(); ++i) empty[i] = labels.solid[i] == 0;
    labels.solid = internal::flood_from_infinity(graph_, empty, options_.solve.progress);
    const internal::Voids voids = internal::find_voids(
        graph_, labels.solid, empty, orientation_.part_of, options_.solve.progress);
    if (cavities == Cavities::fill) {
      report_.filled_voids = voids.count;
    } else {
      for (std::size_t i = 0; i < empty.size(); ++i) {
        if (voids.marked[i] != 0) labels.solid[i] = 0;
      }
    }
    return labels;
  }

  CellLabels by_winding(const std::vector<double>& w) const {
    CellLabels labels;
    for (const double x : w) {
      labels.solid.push_back(x > 0.5 ? 1 : 0);
      labels.confidence.push_back(static_cast<float>(std::min(1.0, 2 * std::abs(x - 0.5))));
    }
    return labels;
  }

  CellLabels by_winding_as_given() {
    const std::vector<double> w = internal::winding_field(graph_, options_.solve, report_);
    measure_trust(w);
    return by_winding(w);
  }

  CellLabels by_trust() {
    std::vector<double> w = internal::winding_field(graph_, options_.solve, report_);
    measure_trust(w);
    report_.reason = why_not_winding(w);
    if (!report_.reason.empty()) {
      report_.used = InsideRule::solidity;
      return by_solidity(options_.cavities);
    }
    const std::vector<double> given = w;
    const InsideReport before = report_;
    w = internal::turn_parts(graph_, orientation_, std::move(w), options_, report_);
    std::vector<double> areas = internal::solid_areas(graph_, orientation_.part_of, w);
    for (double& area : areas) area = std::max(area, options_.least_solid_area);
    const internal::OuterPockets pockets =
        internal::turn_outer_pockets(graph_, orientation_.part_of, areas, w);
    report_.left_out_folds = pockets.left_out;
    CellLabels labels = by_winding(w);
    if (!report_.exact) {
      const InsideReport by_winding_numbers = report_;
      report_ = before;
      CellLabels others = by_solidity(options_.cavities);
      for (std::size_t i = 0; i < pockets.is_left_out.size(); ++i) {
        if (pockets.is_left_out[i] != 0) others.solid[i] = 0;
      }
      const double price_of_others = price(others, given);
      const double price_of_winding = price(labels, given);
      if (price_of_others < kClearlyBetter * price_of_winding) {
        report_.used = InsideRule::solidity;
        report_.left_out_folds = pockets.left_out;
        report_.reason =
            "it takes less made-up surface, and leaves out less of what is there, than the winding "
            "numbers";
        if (differ(others, labels) && kNearlyAsGood * price_of_others > price_of_winding) {
          report_.other = InsideRule::winding;
        }
        return others;
      }
      report_ = by_winding_numbers;
      if (differ(others, labels) && price_of_others < kNearlyAsGood * price_of_winding) {
        report_.other = InsideRule::solidity;
      }
    }
    report_.used = InsideRule::winding;
    report_.reason = why_winding();
    return labels;
  }

  // The area of the solid's boundary that no triangle of the input covers, and that of those which
  // do not bound it and are not inside it as the winding numbers say: what Murali and Funkhouser
  // keep small.
  [[nodiscard]] double price(const CellLabels& labels, const std::vector<double>& w) const {
    double sum = 0;
    for (const Link& link : graph_.links()) {
      const std::size_t below = link.below.index(), above = link.above.index();
      const bool bounds = labels.solid[below] != labels.solid[above];
      const double opacity = link.given ? link.opacity : 0;
      const double share = bounds ? 1 - opacity : opacity;
      if (share == 0) continue;
      const bool explained = link.opaque() && labels.solid[below] != 0 &&
                             std::abs(w[below] - w[above] - link.winding) <= 0.5;
      if (!explained) sum += share * link.area;
    }
    return sum;
  }

  // By more than what is bridged otherwise at holes.
  [[nodiscard]] bool differ(const CellLabels& a, const CellLabels& b) const {
    double all = 0, different = 0;
    for (CellId c(0u); c.index() < graph_.cells(); ++c.value) {
      if (a.solid[c.index()] != 0 || b.solid[c.index()] != 0) all += graph_.volume(c);
      if (a.solid[c.index()] != b.solid[c.index()]) different += graph_.volume(c);
    }
    return different > kMuchOfVolume * all;
  }

  [[nodiscard]] std::string why_winding() const {
    const std::string why = report_.exact ? "the orientation is consistent everywhere"
                                          : "the winding numbers are near integers";
    return why + what_was_turned(report_);
  }

  [[nodiscard]] std::string why_not_winding(const std::vector<double>& w) const {
    if (report_.winding_distance > options_.trusted_distance) {
      return "the winding numbers are far from integers";
    }
    if (report_.winding_contradiction > options_.trusted_contradiction) {
      return "the orientation contradicts itself";
    }
    if (report_.loose_share > options_.trusted_loose_share) {
      return "too much of the surface is open sheets";
    }
    const bool any = std::any_of(w.begin(), w.end(), [](double x) { return std::abs(x) > 0.5; });
    return any ? "" : "the winding numbers enclose nothing";
  }

  void measure_trust(const std::vector<double>& w) {
    double distance = 0, weight = 0, wrong = 0, loose = 0, covered = 0;
    for (const Link& link : graph_.links()) {
      for (const CellId c : {link.below, link.above}) {
        distance += link.area * std::abs(w[c.index()] - std::round(w[c.index()]));
        weight += link.area;
      }
      if (!link.opaque()) continue;
      covered += link.area;
      const double change = w[link.below.index()] - w[link.above.index()];
      if (std::abs(change - link.winding) <= 0.5) continue;
      // A loose sheet between two places alike says nothing of the orientation of the rest.
      (!is_of_shell(link.triangle) && std::abs(change) < 0.5 ? loose : wrong) += link.area;
    }
    report_.winding_distance = weight > 0 ? distance / weight : 0;
    report_.winding_contradiction = covered > loose ? wrong / (covered - loose) : 0;
    report_.loose_share = covered > 0 ? loose / covered : 0;
  }

  [[nodiscard]] bool is_of_shell(TriangleId triangle) const {
    const auto& parts = orientation_.parts;
    return !parts.empty() && parts[orientation_.part_of[triangle]].shell;
  }

  const CellGraph& graph_;
  const Orientation& orientation_;
  const InsideOptions& options_;
  InsideReport& report_;
};

}  // namespace

std::string_view rule_name(InsideRule rule) {
  switch (rule) {
    case InsideRule::solidity:
      return "solidity";
    case InsideRule::parity:
      return "parity";
    case InsideRule::winding:
      return "winding";
    case InsideRule::automatic:
      break;
  }
  return "auto";
}

CellLabels label_cells(const CellGraph& graph, const Orientation& orientation,
                       const InsideOptions& options, InsideReport& report) {
  report = {};
  return InsideDecider(graph, orientation, options, report).run();
}

std::string what_was_turned(const InsideReport& report) {
  std::string text;
  if (report.turned_parts > 0) text += "; " + parts(report.turned_parts) + " inside out and turned";
  if (report.doubtful_parts > 0) {
    text += "; " + parts(report.doubtful_parts) + " that may face either way turned outward";
    if (report.cavity_walls > 0) {
      text += ", but " + std::to_string(report.cavity_walls) + " of them as walls of cavities";
    }
  }
  return text;
}

}  // namespace meshrepair
