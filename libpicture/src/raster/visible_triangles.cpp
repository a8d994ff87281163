// SPDX-License-Identifier: MIT
#include "raster/visible_triangles.h"

#include <algorithm>

#include <base/error.h>
#include <base/parallel.h>

#include "visible_triangles.h"

namespace meshrepair {
namespace {

constexpr std::size_t kMostLists = 4;

struct Bands {
  std::size_t first, last;
};

Bands bands_of(const Range& rows, std::size_t rows_of_band) {
  return {static_cast<std::size_t>(rows.first) / rows_of_band,
          static_cast<std::size_t>(rows.end - 1) / rows_of_band};
}

}  // namespace

RowsOfTriangles::RowsOfTriangles(std::span<const Range> rows_of, std::size_t rows,
                                 std::size_t rows_of_band)
    : rows_(rows), rows_of_band_(rows_of_band), begin_(tasks_of(rows, rows_of_band) + 1) {
  const auto visit_listed = [&](const auto& visit) {
    for (std::size_t t = 0; t < rows_of.size(); ++t) {
      if (rows_of[t].empty()) continue;
      const Bands bands = bands_of(rows_of[t], rows_of_band);
      if (bands.last - bands.first >= kMostLists) continue;
      for (std::size_t band = bands.first; band <= bands.last; ++band) visit(t, band);
    }
  };
  visit_listed([&](std::size_t, std::size_t band) { ++begin_[band + 1]; });
  for (std::size_t band = 0; band + 1 < begin_.size(); ++band) begin_[band + 1] += begin_[band];
  listed_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  visit_listed([&](std::size_t t, std::size_t band) {
    listed_[next[band]++] = static_cast<std::uint32_t>(t);
  });
  for (std::size_t t = 0; t < rows_of.size(); ++t) {
    if (rows_of[t].empty()) continue;
    const Bands bands = bands_of(rows_of[t], rows_of_band);
    if (bands.last - bands.first >= kMostLists) tall_.push_back(static_cast<std::uint32_t>(t));
  }
}

Range RowsOfTriangles::rows(std::size_t band) const {
  const std::size_t first = band * rows_of_band_;
  return {static_cast<std::int64_t>(first),
          static_cast<std::int64_t>(std::min(first + rows_of_band_, rows_))};
}

namespace {

constexpr std::size_t kPerTask = 1 << 14;
constexpr std::size_t kPixelRowsOfBand = 8;  // so that a band of samples stays in the cache

constexpr std::uint32_t kBehind = std::uint32_t{1} << 31;

// Depths as whole numbers from 1 on. Larger samples hide smaller ones.
VisibleTriangles::Sample sample_of(double depth, std::uint32_t rank) {
  constexpr double kSteps = 4294967294.0;
  const auto steps = static_cast<std::uint32_t>(depth * kSteps) + 1;
  return (VisibleTriangles::Sample{steps} << 32) | ~rank;
}

std::vector<SnappedPoint> snapped_points(const TriangleSoup& soup, const Camera& camera,
                                         unsigned samples) {
  if (soup.triangles.size() >= kBehind) throw LimitError("too many triangles for a picture");
  std::vector<SnappedPoint> points(soup.points.size());
  parallel_tasks(points.size(), kPerTask, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
      points[p] = snapped(camera.place(soup.points[p]), samples);
    }
  });
  return points;
}

}  // namespace

VisibleTriangles::VisibleTriangles(const TriangleSoup& soup, const Camera& camera, unsigned samples)
    : soup_(soup),
      camera_(camera),
      columns_(std::size_t{camera.size().width} * samples),
      points_(snapped_points(soup, camera, samples)),
      rows_(rows_of_triangles(), std::size_t{camera.size().height} * samples,
            kPixelRowsOfBand * samples) {}

VisibleTriangles::Seen VisibleTriangles::seen(Sample sample) {
  const std::uint32_t rank = ~static_cast<std::uint32_t>(sample);
  return {rank & ~kBehind, (rank & kBehind) != 0};
}

SnappedTriangle VisibleTriangles::snapped_triangle(std::uint32_t triangle) const {
  const auto& [a, b, c] = soup_.triangles[triangle];
  return {points_[a], points_[b], points_[c]};
}

std::vector<Range> VisibleTriangles::rows_of_triangles() const {
  std::vector<Range> rows(soup_.triangles.size());
  const Range all{0, static_cast<std::int64_t>(camera_.size().height) *
                         static_cast<std::int64_t>(columns_ / camera_.size().width)};
  parallel_tasks(rows.size(), kPerTask, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const auto& corners = soup_.triangles[t];
      const bool shown = std::all_of(corners.begin(), corners.end(),
                                     [&](std::uint32_t p) { return points_[p].shown; });
      if (!shown) continue;
      const SnappedTriangle triangle = snapped_triangle(static_cast<std::uint32_t>(t));
      if (!triangle.empty()) rows[t] = triangle.rows(all);
    }
  });
  return rows;
}

void VisibleTriangles::look(std::size_t band, SharedProgress& progress,
                            std::vector<Sample>& samples) const {
  const Range rows = rows_.rows(band);
  samples.assign(static_cast<std::size_t>(rows.end - rows.first) * columns_, kNothing);
  constexpr std::size_t kTrianglesPerPoll = 64;  // each of which may be as large as the band
  std::size_t drawn = 0;
  rows_.visit(band, [&](std::uint32_t triangle) {
    if (++drawn % kTrianglesPerPoll == 0) progress.poll();
    draw(triangle, rows, samples);
  });
}

void VisibleTriangles::draw(std::uint32_t number, const Range& rows,
                            std::vector<Sample>& samples) const {
  const SnappedTriangle triangle = snapped_triangle(number);
  const Range columns{0, static_cast<std::int64_t>(columns_)};
  const Range within = triangle.rows(rows);
  bool is_ranked = false;
  std::uint32_t rank = number;
  for (std::int64_t row = within.first; row < within.end; ++row) {
    const Range covered = triangle.covered(row, columns);
    if (covered.empty()) continue;
    if (!is_ranked) {
      // Not by its corners on the grid: these turn triangles over that are seen from the side.
      const auto& [a, b, c] = soup_.triangles[number];
      const Vec3d normal = camera_.normal(soup_.points[a], soup_.points[b], soup_.points[c]);
      if (normal[2] < 0) rank |= kBehind;
      is_ranked = true;
    }
    Sample* const line = &samples[static_cast<std::size_t>(row - rows.first) * columns_];
    for (std::int64_t column = covered.first; column < covered.end; ++column) {
      const double depth = triangle.depth(column, row);
      line[column] = std::max(line[column], sample_of(depth, rank));
    }
  }
}

}  // namespace meshrepair
