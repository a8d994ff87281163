#include "boxes_around.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include <check/internal/triangle_list.h>
#include <check/internal/triangles_near.h>

namespace meshrepair::internal {
namespace {

bool covers(const Box& all, const Box& part) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(all.low[k] <= part.low[k] && part.high[k] <= all.high[k])) return false;
  }
  return true;
}

}  // namespace

BoxesAround::BoxesAround(const TriangleSoup& mesh, std::vector<Box> places)
    : mesh_(mesh), places_(std::move(places)) {
  take(triangles_near(mesh_, places_, 0));
}

void BoxesAround::find(const Box& box, std::vector<std::uint32_t>& found) {
  if (!has_all_ && !is_at_a_place(box)) take_all();
  tree_->visit([&](const Box& other) { return other.meets(box); },
               [&](std::uint32_t i) {
                 if (boxes_[i].meets(box)) found.push_back(triangles_[i]);
               });
}

bool BoxesAround::is_at_a_place(const Box& box) const {
  return std::any_of(places_.begin(), places_.end(),
                     [&](const Box& place) { return covers(place, box); });
}

void BoxesAround::take(std::vector<std::uint32_t> triangles) {
  triangles_ = std::move(triangles);
  boxes_.resize(triangles_.size());
  for (std::size_t i = 0; i < boxes_.size(); ++i) boxes_[i] = box_of(mesh_, triangles_[i]);
  tree_.emplace(boxes_);
}

void BoxesAround::take_all() {
  std::vector<std::uint32_t> all(mesh_.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  take(std::move(all));
  has_all_ = true;
}

}  // namespace meshrepair::internal
