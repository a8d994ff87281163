// SPDX-License-Identifier: MIT
#include "minimum_cut.h"

#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <cstddef>
#include <utility>

namespace meshrepair::internal {
namespace {

using Network =
    boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                       boost::no_property, std::uint32_t, std::uint32_t>;
using Arc = Network::edge_descriptor;

// The nodes, then the source, on whose side of the cut the set is, and the sink. Arcs come in
// pairs, there and back. What it costs to have a node in the set is that of its arc to the sink,
// and to have it out, that of the arc from the source; what both have in common is spent in any
// case.
class FlowProblem {
 public:
  FlowProblem(std::span<const CutNode> nodes, std::span<const CutEdge> edges)
      : source_(static_cast<std::uint32_t>(nodes.size())), sink_(source_ + 1) {
    for (std::uint32_t n = 0; n < source_; ++n) {
      if (nodes[n].out > nodes[n].in) add(source_, n, nodes[n].out - nodes[n].in, 0);
      if (nodes[n].in > nodes[n].out) add(n, sink_, nodes[n].in - nodes[n].out, 0);
    }
    for (const CutEdge& e : edges) {
      if (e.cost > 0 && e.from != e.to) add(e.from, e.to, e.cost, e.cost);
    }
  }

  std::vector<char> source_side() {
    sort_arcs();
    Network network(boost::edges_are_sorted, ends_.begin(), ends_.end(), sink_ + 1);
    find_flow(network);
    std::vector<char> side = reached_from_source(network);
    side.resize(source_);
    return side;
  }

 private:
  using Ends = std::pair<std::uint32_t, std::uint32_t>;

  void add(std::uint32_t from, std::uint32_t to, std::int64_t there, std::int64_t back) {
    ends_.emplace_back(from, to);
    capacity_.push_back(there);
    ends_.emplace_back(to, from);
    capacity_.push_back(back);
  }

  // By where they start, as the network wants them, with the other one of each pair.
  void sort_arcs() {
    std::vector<std::uint32_t> next(sink_ + 2, 0);
    for (const Ends& e : ends_) ++next[e.first + 1];
    for (std::size_t n = 1; n < next.size(); ++n) next[n] += next[n - 1];
    std::vector<std::uint32_t> place(ends_.size());
    for (std::size_t a = 0; a < ends_.size(); ++a) place[a] = next[ends_[a].first]++;
    std::vector<Ends> ends(ends_.size());
    std::vector<std::int64_t> capacity(ends_.size());
    reverse_.resize(ends_.size());
    for (std::size_t a = 0; a < ends_.size(); ++a) {
      ends[place[a]] = ends_[a];
      capacity[place[a]] = capacity_[a];
      reverse_[place[a]] = Arc(ends_[a].second, place[a ^ 1]);
    }
    ends_ = std::move(ends);
    capacity_ = std::move(capacity);
  }

  void find_flow(Network& network) {
    const std::size_t nodes = ends_.empty() ? 0 : sink_ + std::size_t{1};
    if (nodes == 0) return;
    residual_.resize(capacity_.size());
    std::vector<Arc> parent(nodes);
    std::vector<boost::default_color_type> color(nodes);
    std::vector<std::int64_t> distance(nodes);
    const auto arc_index = boost::get(boost::edge_index, network);
    const auto node_index = boost::get(boost::vertex_index, network);
    const auto of_arcs = [&](auto& values) {
      return boost::make_iterator_property_map(values.begin(), arc_index);
    };
    const auto of_nodes = [&](auto& values) {
      return boost::make_iterator_property_map(values.begin(), node_index);
    };
    boost::boykov_kolmogorov_max_flow(network, of_arcs(capacity_), of_arcs(residual_),
                                      of_arcs(reverse_), of_nodes(parent), of_nodes(color),
                                      of_nodes(distance), node_index, source_, sink_);
  }

  // The least of all sides that a greatest flow leaves; the search trees have other nodes, too.
  [[nodiscard]] std::vector<char> reached_from_source(const Network& network) const {
    std::vector<char> reached(sink_ + std::size_t{1}, 0);
    std::vector<std::uint32_t> queue = {source_};
    reached[source_] = 1;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      for (auto [arc, end] = boost::out_edges(queue[next], network); arc != end; ++arc) {
        const std::uint32_t to = boost::target(*arc, network);
        if (reached[to] != 0 || residual_[arc->idx] == 0) continue;
        reached[to] = 1;
        queue.push_back(to);
      }
    }
    return reached;
  }

  std::uint32_t source_, sink_;
  std::vector<Ends> ends_;
  std::vector<std::int64_t> capacity_, residual_;
  std::vector<Arc> reverse_;
};

}  // namespace

std::vector<char> minimum_cut(std::span<const CutNode> nodes, std::span<const CutEdge> edges) {
  return FlowProblem(nodes, edges).source_side();
}

}  // namespace meshrepair::internal
