// SPDX-License-Identifier: MIT
// The result says of each of its triangles which one of the input it lies in. Of those that it does
// not name, the places of their pieces tell, which are known for each triangle of the clean soup.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <base/stage_meter.h>
#include <mesh/weld_points.h>
#include <repair/explain_repair.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

#include "describe_result.h"
#include "prepare/prepare.h"

namespace meshrepair {
namespace {

constexpr std::array<std::string_view, kTriangleFates> kFateNames = {
    "left_out", "thickened", "turned",    "whole",   "cut",
    "moved",    "inside",    "duplicate", "dropped", "outside"};
constexpr std::array<std::string_view, kTriangleOrigins> kOriginNames = {"whole", "piece", "wall",
                                                                         "patch", "seal"};

using Corners = std::array<std::uint32_t, 3>;

Vec3d normal_of(const TriangleSoup& mesh, std::size_t t) {
  const Corners& c = mesh.triangles[t];
  const Vec3d& base = mesh.points[c[0]];
  return (mesh.points[c[1]] - base).cross(mesh.points[c[2]] - base);
}

class Explainer {
 public:
  Explainer(const TriangleSoup& soup, const Surface& surface, const RepairOptions& options,
            const RepairReport& report)
      : soup_(soup),
        surface_(surface),
        report_(report),
        known_(soup.triangles.size()),
        clean_(clean_again(soup, options)) {}

  RepairExplanation run() {
    look_at_clean();
    look_at_result();
    find_duplicates();
    RepairExplanation explanation;
    for (const Known& known : known_) explanation.fates.push_back(fate_of(known));
    explanation.origins = find_origins(soup_, explanation.fates, surface_);
    return explanation;
  }

 private:
  // Of a triangle of the input.
  struct Known {
    bool is_clean = false;      // it is in the clean soup
    bool is_sewn = false;       // and has another corner there
    bool is_in_result = false;  // there is a triangle that lies in it
    bool is_whole = false;
    bool is_turned = false;
    bool is_duplicate = false;  // of one that is in the clean soup
    std::uint8_t places = 0;    // of its pieces
  };

  // As it was before holes were closed.
  static CleanSoup clean_again(const TriangleSoup& soup, const RepairOptions& options) {
    RepairOptions as_far = options;
    as_far.holes.mode = HoleMode::none;
    RepairReport again;
    StageMeter meter(again.stages, nullptr);
    return internal::close_soup(soup, as_far, again, meter);
  }

  void look_at_clean() {
    const std::vector<std::uint8_t>& places = report_.parts.places;
    for (TriangleId t(0u); t < clean_.triangles.end_id(); ++t.value) {
      const Triangle& triangle = clean_.triangles[t];
      if (triangle.source == Triangle::kNoSource) continue;
      Known& known = known_[triangle.source];
      known.is_clean = true;
      known.places |= t.index() < places.size() ? places[t.index()] : kOnBoundary;
      known.is_sewn |= report_.sew.distance > 0 && has_other_corner(triangle);
    }
  }

  [[nodiscard]] bool has_other_corner(const Triangle& triangle) const {
    const Corners& given = soup_.triangles[triangle.source];
    return std::any_of(triangle.corners.begin(), triangle.corners.end(), [&](PointId p) {
      return std::none_of(given.begin(), given.end(),
                          [&](std::uint32_t q) { return clean_.points[p] == soup_.points[q]; });
    });
  }

  void look_at_result() {
    for (std::size_t t = 0; t < surface_.source.size(); ++t) {
      const std::uint32_t source = surface_.source[t];
      if (source == Surface::kNoSource) continue;
      Known& known = known_[source];
      known.is_in_result = true;
      known.is_whole |= internal::has_corners_of_source(soup_, surface_, t);
      known.is_turned |= normal_of(surface_.mesh, t).dot(normal_of(soup_, source)) < 0;
    }
  }

  void find_duplicates() {
    const std::vector<std::uint32_t> first = first_in_place(soup_.points);
    std::vector<std::pair<Corners, std::uint32_t>> all;
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      Corners corners = soup_.triangles[t];
      for (std::uint32_t& p : corners) p = first[p];
      std::sort(corners.begin(), corners.end());
      all.emplace_back(corners, t);
    }
    std::sort(all.begin(), all.end());
    for (std::size_t begin = 0; begin < all.size();) {
      std::size_t end = begin;
      bool any_clean = false;
      for (; end < all.size() && all[end].first == all[begin].first; ++end) {
        any_clean |= known_[all[end].second].is_clean;
      }
      for (; begin < end; ++begin) known_[all[begin].second].is_duplicate = any_clean;
    }
  }

  [[nodiscard]] TriangleFate fate_of(const Known& known) const {
    if ((known.places & kThickened) != 0) return TriangleFate::thickened;
    if (known.is_in_result) {
      if (known.is_turned) return TriangleFate::turned;
      if (known.is_whole) return TriangleFate::whole;
      return known.is_sewn ? TriangleFate::moved : TriangleFate::cut;
    }
    if (!known.is_clean) {
      return known.is_duplicate ? TriangleFate::duplicate : TriangleFate::dropped;
    }
    if ((known.places & kOnBoundary) != 0) return TriangleFate::cut;
    if (known.places == 0) return TriangleFate::duplicate;
    return known.places == kInside ? TriangleFate::inside : TriangleFate::outside;
  }

  const TriangleSoup& soup_;
  const Surface& surface_;
  const RepairReport& report_;
  std::vector<Known> known_;  // of each triangle of the input
  const CleanSoup clean_;
};

}  // namespace

std::string_view fate_name(TriangleFate fate) { return kFateNames[static_cast<std::size_t>(fate)]; }

std::string_view origin_name(TriangleOrigin origin) {
  return kOriginNames[static_cast<std::size_t>(origin)];
}

std::vector<TriangleOrigin> find_origins(const TriangleSoup& soup,
                                         const std::vector<TriangleFate>& fates,
                                         const Surface& surface) {
  std::vector<TriangleOrigin> origins(surface.source.size(), TriangleOrigin::patch);
  for (std::size_t t = 0; t < origins.size(); ++t) {
    const std::uint32_t source = surface.source[t];
    if (source == Surface::kNoSource) continue;
    if (fates[source] == TriangleFate::thickened) {
      origins[t] = TriangleOrigin::wall;
    } else {
      origins[t] = internal::has_corners_of_source(soup, surface, t) ? TriangleOrigin::whole
                                                                     : TriangleOrigin::piece;
    }
  }
  return origins;
}

void leave_out(const Surface& surface, const std::vector<char>& stays,
               RepairExplanation& explanation) {
  std::vector<TriangleOrigin>& origins = explanation.origins;
  if (origins.empty()) return;
  std::vector<char> is_left(explanation.fates.size(), 0);
  std::size_t left = 0;
  for (std::size_t t = 0; t < stays.size(); ++t) {
    if (stays[t] == 0) continue;
    origins[left++] = origins[t];
    if (surface.source[t] != Surface::kNoSource) is_left[surface.source[t]] = 1;
  }
  origins.resize(left);
  for (const std::uint32_t source : surface.source) {
    if (source == Surface::kNoSource || is_left[source] != 0) continue;
    explanation.fates[source] = TriangleFate::left_out;
  }
}

RepairExplanation explain_repair(const TriangleSoup& soup, const Surface& surface,
                                 const RepairOptions& options, const RepairReport& report) {
  return Explainer(soup, surface, options, report).run();
}

}  // namespace meshrepair
