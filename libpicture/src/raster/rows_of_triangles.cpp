#include "raster/rows_of_triangles.h"

#include <algorithm>

#include <base/parallel.h>

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

}  // namespace meshrepair
