// SPDX-License-Identifier: MIT
// Open edges that nearly meet are brought together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

namespace meshrepair {

enum class SewMode {
  automatic,  // as far as the soup itself tells
  none,
  distance,  // as far as is asked for
};

struct SewOptions {
  SewMode mode = SewMode::automatic;
  double distance = 0;    // of SewMode::distance, in the soup's unit
  bool is_share = false;  // it is a share of the diagonal of the soup's bounding box instead
  ProgressObserver* progress = nullptr;
};

struct SewReport {
  double distance = 0;             // that sewing was to span at most; 0: nothing was sewn
  double widest_gap = 0;           // that it spans: between corners, or from one to an edge
  std::size_t open_edges = 0;      // before
  std::size_t sewn_edges = 0;      // of these
  std::size_t joined_points = 0;   // that had different coordinates
  std::size_t split_edges = 0;     // at a corner that lies beside them
  double farthest_move = 0;        // of a corner
  std::size_t lost_triangles = 0;  // smaller than the distance, of which corners became one
  double refused_distance = 0;     // that corners are apart, but not sewn: see sew_soup()
};

struct SewnSoup {
  TriangleSoup soup;
  std::vector<std::uint32_t> source;  // of each triangle, that of the soup that was given
};

// Clusters corners at open edges that lie near each other, and moves each cluster to its middle. An
// open edge beside which a corner lies gets it as a point. No cluster has two corners of one
// triangle, and none is wider than twice the distance. A corner is moved by less than a third of
// the edges at it. A cluster is given up that would turn a triangle over, make an edge of more than
// two triangles, or closes no open edge.
//
// Where hardly any edge has two triangles, noise has put all corners where they are. What is
// smaller than it has no shape then: corners of one triangle may become one, too, and slivers turn
// over.
//
// SewMode::automatic compares how far corners are from the nearest open edge that is not theirs
// with the edges at them. Corners that are much nearer are apart by mistake. It sews over twice the
// largest of these distances, at most a 250th of the diagonal of the bounding box. If most corners
// are farther apart than that, nothing is sewn, and report.refused_distance is set; so it is
// where so many corners are within the distance that they cannot be told apart. Nothing is sewn
// either if fewer edges find a partner than corners are moved and edges split.
//
// Nothing if there is nothing to sew. n log n. Throws Cancelled.
[[nodiscard]] std::optional<SewnSoup> sew_soup(const TriangleSoup& soup, const SewOptions& options,
                                               SewReport& report);

}  // namespace meshrepair
