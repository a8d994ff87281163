// SPDX-License-Identifier: MIT
// Each triangle is divided into pieces where something may be near enough, and each piece asks at
// its middle which ball fits behind it, and which one in front. The samples that are thin are then
// connected to places.
//
// Coordinates are brought to at most 1 by a power of two, so that no square overflows. Each
// triangle begins at its lowest corner, whatever the order of its corners in the soup.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include <base/ids.h>
#include <base/parallel.h>
#include <base/shared_progress.h>
#include <check/thin_places.h>
#include <mesh/mesh_parts.h>

#include "facing_triangles.h"
#include "thin_samples.h"
#include "triangle_piece.h"

namespace meshrepair {
namespace {

using internal::Contact;
using internal::FacingTriangles;
using internal::Hit;
using internal::kOpposite;
using internal::kWedge;
using internal::MeasuredTriangle;
using internal::TangentBalls;
using internal::ThinSample;
using internal::ThinSamples;
using internal::TrianglePiece;

// Some seconds of work, and half a gigabyte if all of them are thin.
constexpr double kMostThinPieces = 0x1p21;
// A larger ball is as good as a plane: of the diagonal of the bounding box.
constexpr double kLargestLimit = 1024;
// A pin is at most so many times as wide as it is thick.
constexpr double kPinWidth = 4;
// Of a triangle that tells which way that is: its normal is at least 45 degrees off.
constexpr double kSideways = 0.7;
// Of the segment between the two points where a ball touches: what crosses it farther out is a
// neighbour of the triangles that it touches.
constexpr double kSegmentLow = 0.01, kSegmentHigh = 0.99;

// Of the square of the limit, and of the surface: the lesser is the least area of a place. Meshes
// have slivers whose normals are rounded to any direction, so that they are folded over, and these
// are as thin as they are narrow.
constexpr double kLeastOfLimit = 0.01, kLeastOfSurface = 0.001;

constexpr std::size_t kSampledPerTask = 256;
// A few milliseconds of work.
constexpr std::size_t kPiecesPerQuestion = 256;

bool is_lower(const Vec3d& p, const Vec3d& q) {
  return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
}

// Of the coordinates of triangles that are finite.
UnitScale scale_of(const TriangleSoup& soup) {
  Vec3d largest = Vec3d::Zero();
  for (const auto& [a, b, c] : soup.triangles) {
    const std::array<Vec3d, 3> corners = {soup.points[a], soup.points[b], soup.points[c]};
    if (!std::all_of(corners.begin(), corners.end(), [](const Vec3d& p) { return p.allFinite(); }))
      continue;
    for (const Vec3d& p : corners) largest = largest.cwiseMax(p.cwiseAbs());
  }
  return UnitScale(std::array{largest});
}

// Sorted by their corners, so that what is found does not depend on the order in the soup.
std::vector<MeasuredTriangle> measured(const TriangleSoup& soup, const UnitScale& scale) {
  std::vector<MeasuredTriangle> triangles;
  triangles.reserve(soup.triangles.size());
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    MeasuredTriangle one;
    auto& corners = one.corners;
    corners = {scale(soup.points[a]), scale(soup.points[b]), scale(soup.points[c])};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), is_lower),
                corners.end());
    const Vec3d across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double length = across.norm();
    if (!(std::isfinite(length) && length > std::sqrt(std::numeric_limits<double>::min()))) {
      continue;  // without an area, or not finite
    }
    one.normal = across / length;
    one.area = 0.5 * length;
    one.id = t;
    triangles.push_back(one);
  }
  parallel_sort(triangles.begin(), triangles.end(), internal::comes_first);
  return triangles;
}

// What may be thin about a piece.
struct Chances {
  bool behind = true, in_front = true;
  [[nodiscard]] bool any() const { return behind || in_front; }
};

class ThinPlacesFinder {
 public:
  ThinPlacesFinder(const FacingTriangles& facing, double limit)
      : facing_(facing), limit_(limit), spacing_(0.5 * limit) {
    widen_spacing();
  }

  [[nodiscard]] double spacing() const { return spacing_; }
  // Of a piece that is small enough.
  [[nodiscard]] double square() const { return spacing_ * spacing_; }

  [[nodiscard]] ThinSamples samples(ProgressObserver* progress) const {
    SharedProgress shared(progress, tasks_of(facing_.triangles().size(), kSampledPerTask));
    return parallel_reduce(
        facing_.triangles().size(), kSampledPerTask,
        [&](std::size_t first, std::size_t last) {
          ThinSamples some;
          std::size_t steps = 0;
          for (std::size_t t = first; t < last; ++t) {
            add_pieces(static_cast<std::uint32_t>(t), {facing_.triangles()[t].corners}, {}, steps,
                       shared, some);
          }
          shared.done();
          return some;
        },
        [](ThinSamples& all, ThinSamples&& part) {
          if (all.empty()) return std::swap(all, part);
          all.insert(all.end(), part.begin(), part.end());
        });
  }

 private:
  [[nodiscard]] TangentBalls balls(const MeasuredTriangle& triangle, const Vec3d& point,
                                   bool in_front, double most_cosine) const {
    return {point, triangle.normal, in_front, most_cosine};
  }

  [[nodiscard]] Chances chances(const MeasuredTriangle& triangle, const TrianglePiece& piece,
                                Chances before) const {
    const Vec3d middle = piece.middle();
    double radius = 0;
    for (const Vec3d& p : piece.corners) radius = std::max(radius, (p - middle).norm());
    return {before.behind &&
                facing_.may_have_contact(balls(triangle, middle, false, kWedge), radius, limit_),
            before.in_front &&
                facing_.may_have_contact(balls(triangle, middle, true, kOpposite), radius, limit_)};
  }

  // A piece has about half the largest area that it may have, and the pieces of a needle are as
  // many as its length has spacings, or twice as many.
  void widen_spacing() {
    double area = 0, length = 0;
    std::vector<double> areas, lengths;
    for (const MeasuredTriangle& triangle : facing_.triangles()) {
      const TrianglePiece whole{triangle.corners};
      if (!whole.is_to_halve(square()) || !chances(triangle, whole, {}).any()) continue;
      std::size_t begin = 0;
      areas.push_back(triangle.area);
      lengths.push_back(std::sqrt(whole.longest_side(begin)));
    }
    area = internal::sum_of(std::move(areas));
    length = internal::sum_of(std::move(lengths));
    while (4 * area / square() + 2 * length / spacing_ > kMostThinPieces) spacing_ *= 2;
  }

  void add_pieces(std::uint32_t t, const TrianglePiece& piece, Chances before, std::size_t& steps,
                  SharedProgress& progress, ThinSamples& samples) const {
    if (++steps % kPiecesPerQuestion == 0) progress.poll();
    const MeasuredTriangle& triangle = facing_.triangles()[t];
    if (!piece.is_to_halve(square())) {
      if (before.behind) add_behind(t, piece, samples);
      if (before.in_front) add_in_front(t, piece, samples);
      return;
    }
    const Chances here = chances(triangle, piece, before);
    if (!here.any()) return;
    for (const TrianglePiece& half : piece.halves())
      add_pieces(t, half, here, steps, progress, samples);
  }

  // Without the triangles between.
  [[nodiscard]] std::optional<Contact> contact(const TangentBalls& balls) const {
    std::optional<Contact> found = facing_.contact(balls, limit_);
    if (!found) return found;
    const Vec3d along = found->at - balls.point;
    const Hit between = facing_.first_hit(balls.point, along, kSegmentLow, kSegmentHigh);
    return between.triangle == kNone ? found : std::nullopt;
  }

  void add_behind(std::uint32_t t, const TrianglePiece& piece, ThinSamples& samples) const {
    const MeasuredTriangle& triangle = facing_.triangles()[t];
    const Vec3d at = piece.middle();
    ThinKind kind = ThinKind::wall;
    std::optional<Contact> found = contact(balls(triangle, at, false, kOpposite));
    if (!found) {
      kind = ThinKind::edge;
      found = contact(balls(triangle, at, false, kWedge));
      if (found && is_tip_cut_off(triangle, at, *found)) return;
    }
    if (!found) return;
    if (is_pin(at, triangle.normal, found->diameter)) kind = ThinKind::pin;
    add(t, piece, kind, *found, samples);
  }

  // Whether the two faces of a wedge do not reach its tip, but end at others before the ball.
  [[nodiscard]] bool is_tip_cut_off(const MeasuredTriangle& triangle, const Vec3d& at,
                                    const Contact& contact) const {
    const Vec3d& other = facing_.triangles()[contact.triangle].normal;
    const Vec3d outward = (triangle.normal + other).normalized();
    const double radius = 0.5 * contact.diameter;
    return facing_.has_in_ball(at - radius * triangle.normal, radius, outward);
  }

  void add_in_front(std::uint32_t t, const TrianglePiece& piece, ThinSamples& samples) const {
    const MeasuredTriangle& triangle = facing_.triangles()[t];
    const auto found = contact(balls(triangle, piece.middle(), true, kOpposite));
    if (found) add(t, piece, ThinKind::gap, *found, samples);
  }

  void add(std::uint32_t t, const TrianglePiece& piece, ThinKind kind, const Contact& contact,
           ThinSamples& samples) const {
    samples.push_back({piece.corners, piece.path, facing_.triangles()[t].area * piece.share(),
                       piece.middle(), t, kind, contact});
  }

  [[nodiscard]] bool is_pin(const Vec3d& at, const Vec3d& normal, double thickness) const {
    const Vec3d centre = at - 0.5 * thickness * normal;
    const double most = std::min(limit_, kPinWidth * thickness);
    // One end of the line is as near as half of its length.
    const std::uint32_t side = facing_.nearest_sideways(centre, normal, kSideways, 0.5 * most);
    if (side == kNone) return false;
    const Vec3d& sideways = facing_.triangles()[side].normal;
    const Vec3d across = (sideways - sideways.dot(normal) * normal).normalized();
    const double width = std::min(width_along(centre, across, most),
                                  width_along(centre, normal.cross(across), most));
    return width < most && thickness <= kPinWidth * width;
  }

  // Between two triangles that face each other; `most` where there are none so near.
  [[nodiscard]] double width_along(const Vec3d& centre, const Vec3d& along, double most) const {
    const Hit ahead = facing_.first_hit(centre, along, 0, most);
    if (ahead.triangle == kNone) return most;
    const Hit behind = facing_.first_hit(centre, -along, 0, most - ahead.t);
    if (behind.triangle == kNone) return most;
    const auto triangles = facing_.triangles();
    const double cosine = triangles[ahead.triangle].normal.dot(triangles[behind.triangle].normal);
    return cosine <= kWedge ? ahead.t + behind.t : most;
  }

  const FacingTriangles& facing_;
  double limit_;
  double spacing_;
};

double diagonal_of(std::span<const MeasuredTriangle> triangles) {
  Box box;
  for (const MeasuredTriangle& triangle : triangles) {
    for (const Vec3d& p : triangle.corners) box.add(p);
  }
  return box.diagonal();
}

// Samples of one piece, of which there are two at most, come one after the other.
double thin_area(const ThinSamples& samples) {
  std::vector<double> areas;
  areas.reserve(samples.size());
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const bool is_counted = s > 0 && samples[s - 1].is_told &&
                            samples[s - 1].triangle == samples[s].triangle &&
                            samples[s - 1].path == samples[s].path;
    if (samples[s].is_told && !is_counted) areas.push_back(samples[s].area);
  }
  return internal::sum_of(std::move(areas));
}

double area_of(std::span<const MeasuredTriangle> triangles) {
  std::vector<double> areas;
  areas.reserve(triangles.size());
  for (const MeasuredTriangle& triangle : triangles) areas.push_back(triangle.area);
  return internal::sum_of(std::move(areas));
}

ThinPlaces in_units(std::vector<ThinPlace> places, std::size_t most, const UnitScale& scale) {
  ThinPlaces all;
  all.count = places.size();
  std::vector<double> areas;
  areas.reserve(places.size());
  for (const ThinPlace& place : places) areas.push_back(place.area);
  all.area = scale.back(scale.back(internal::sum_of(std::move(areas))));
  places.resize(std::min(most, places.size()));
  for (ThinPlace& place : places) {
    place.at = scale.back(place.at);
    place.thickness = scale.back(place.thickness);
    place.area = scale.back(scale.back(place.area));
  }
  all.first = std::move(places);
  return all;
}

void mark(const ThinSamples& samples, std::span<const MeasuredTriangle> triangles,
          std::vector<std::uint8_t>& marks) {
  for (const ThinSample& sample : samples) {
    if (!sample.is_told) continue;
    marks[triangles[sample.triangle].id] |=
        static_cast<std::uint8_t>(1U << static_cast<unsigned>(sample.kind));
  }
}

}  // namespace

ThinReport find_thin_places(const TriangleSoup& soup, const ThinOptions& options) {
  if (options.progress != nullptr) options.progress->stage("thickness");
  ThinReport report;
  if (options.mark_triangles) report.marks.assign(soup.triangles.size(), 0);
  const UnitScale scale = scale_of(soup);
  const FacingTriangles facing(measured(soup, scale));
  const double diagonal = diagonal_of(facing.triangles());
  report.limit = options.is_share ? options.limit * scale.back(diagonal) : options.limit;
  if (facing.triangles().empty()) return report;
  const double limit = std::min(options.is_share ? options.limit * diagonal : scale(options.limit),
                                kLargestLimit * diagonal);
  const ThinPlacesFinder finder(facing, limit);
  ThinSamples samples = finder.samples(options.progress);
  const double area = area_of(facing.triangles());
  const double least_area = std::min(kLeastOfLimit * limit * limit, kLeastOfSurface * area);
  for (std::size_t k = 0; k < kThinKinds; ++k) {
    report.kinds[k] =
        in_units(internal::find_places(static_cast<ThinKind>(k), samples, facing.triangles(),
                                       finder.square(), least_area),
                 options.most_places, scale);
  }
  report.spacing = scale.back(finder.spacing());
  report.area = scale.back(scale.back(area));
  // The sum of all pieces may be rounded to more.
  report.thin_area = std::min(scale.back(scale.back(thin_area(samples))), report.area);
  if (options.mark_triangles) mark(samples, facing.triangles(), report.marks);
  return report;
}

}  // namespace meshrepair
