#include <algorithm>
#include <cmath>

#include <repair/flood.h>
#include <repair/inside_rule.h>
#include <repair/walk.h>

namespace meshrepair {
namespace {

class InsideDecider {
 public:
  InsideDecider(const CellGraph& graph, const InsideOptions& options, InsideReport& report)
      : graph_(graph), options_(options), report_(report) {}

  CellLabels run() {
    report_.asked = report_.used = options_.rule;
    CellLabels labels;
    switch (options_.rule) {
      case InsideRule::parity:
        labels = by_parity();
        break;
      case InsideRule::solidity:
        labels = by_solidity();
        break;
      case InsideRule::winding:
        labels = by_winding(winding());
        break;
      case InsideRule::automatic:
        labels = by_trust();
        break;
    }
    if (report_.reason.empty()) report_.reason = "asked for";
    report_.solid_cells =
        static_cast<std::size_t>(std::count(labels.solid.begin(), labels.solid.end(), 1));
    return labels;
  }

 private:
  std::vector<double> solidity() {
    const Walk walk = walk_parity(graph_, options_.solve.progress);
    note_walk(walk);
    if (!walk.consistent()) return solve_solidity(graph_, options_.solve, report_.solve);
    std::vector<double> s(graph_.cells());
    for (std::size_t i = 0; i < s.size(); ++i) s[i] = 2.0 * walk.value[i] - 1.0;
    return s;
  }

  std::vector<double> winding() {
    const Walk walk = walk_winding(graph_, options_.solve.progress);
    note_walk(walk);
    if (!walk.consistent()) return solve_winding(graph_, options_.solve, report_.solve);
    return {walk.value.begin(), walk.value.end()};
  }

  void note_walk(const Walk& walk) {
    report_.exact = walk.consistent();
    report_.contradictions = walk.contradictions;
  }

  CellLabels by_parity() {
    CellLabels labels;
    for (const double s : solidity()) {
      labels.solid.push_back(s > 0 ? 1 : 0);
      labels.confidence.push_back(static_cast<float>(std::abs(s)));
    }
    return labels;
  }

  CellLabels by_solidity() {
    CellLabels labels = by_parity();
    std::vector<char> empty(labels.solid.size());
    for (std::size_t i = 0; i < empty.size(); ++i) empty[i] = labels.solid[i] == 0;
    labels.solid = flood_from_infinity(graph_, empty, options_.solve.progress);
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

  CellLabels by_trust() {
    std::vector<double> w = winding();
    measure_trust(w);
    const std::string doubt = why_not_winding(w);
    if (doubt.empty()) {
      // A soup that is inside out as a whole has negative windings; it is as solid as any other.
      for (double& x : w) x = std::abs(x);
      report_.used = InsideRule::winding;
      report_.reason = report_.exact ? "the orientation is consistent everywhere"
                                     : "the winding numbers are near integers";
      return by_winding(w);
    }
    report_.used = InsideRule::solidity;
    report_.reason = doubt;
    return by_solidity();
  }

  [[nodiscard]] std::string why_not_winding(const std::vector<double>& w) const {
    if (report_.winding_distance > options_.trusted_distance) {
      return "the winding numbers are far from integers";
    }
    if (report_.winding_contradiction > options_.trusted_contradiction) {
      return "the orientation contradicts itself";
    }
    const bool positive = std::any_of(w.begin(), w.end(), [](double x) { return x > 0.5; });
    const bool negative = std::any_of(w.begin(), w.end(), [](double x) { return x < -0.5; });
    // Where a part that is inside out crosses another, their windings cancel.
    if (positive && negative) return "some parts are inside out";
    return positive || negative ? "" : "the winding numbers enclose nothing";
  }

  void measure_trust(const std::vector<double>& w) {
    double distance = 0, weight = 0, wrong = 0, covered = 0;
    for (const Link& link : graph_.links()) {
      for (const CellId c : {link.below, link.above}) {
        distance += link.area * std::abs(w[c.index()] - std::round(w[c.index()]));
        weight += link.area;
      }
      if (!link.opaque) continue;
      covered += link.area;
      const double change = w[link.below.index()] - w[link.above.index()];
      if (std::abs(change - link.winding) > 0.5) wrong += link.area;
    }
    report_.winding_distance = weight > 0 ? distance / weight : 0;
    report_.winding_contradiction = covered > 0 ? wrong / covered : 0;
  }

  const CellGraph& graph_;
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

CellLabels label_cells(const CellGraph& graph, const InsideOptions& options, InsideReport& report) {
  report = {};
  return InsideDecider(graph, options, report).run();
}

}  // namespace meshrepair
