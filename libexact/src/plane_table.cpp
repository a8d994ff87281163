#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>

#include <base/assert.h>
#include <base/first_equal.h>
#include <base/parallel.h>
#include <base/release.h>
#include <exact/plane_table.h>

namespace meshrepair {
namespace {

std::uint64_t mix(std::uint64_t h, std::uint64_t value) {
  h = (h ^ value) * 0x9E3779B97F4A7C15u;
  return h ^ (h >> 29);
}

std::uint64_t hash_of(const Plane& plane) {
  std::uint64_t h = mix(0, static_cast<std::uint64_t>(plane.normal[0]));
  h = mix(h, static_cast<std::uint64_t>(plane.normal[1]));
  h = mix(h, static_cast<std::uint64_t>(plane.normal[2]));
  h = mix(h, static_cast<std::uint64_t>(plane.offset));
  h = mix(h, static_cast<std::uint64_t>(plane.offset >> 64));
  return h ^ (h >> 32);
}

// The numbers of these slots, by the part of the table that each is in.
std::vector<std::uint32_t> in_parts_of_table(const std::vector<std::uint64_t>& slots) {
  constexpr std::uint64_t kSlotsOfPart = std::uint64_t{1} << 16;
  std::vector<std::size_t> ends;  // where each part ends; first, where the one before it does
  for (const std::uint64_t slot : slots) {
    const std::size_t part = slot / kSlotsOfPart;
    if (part + 2 > ends.size()) ends.resize(part + 2);
    ++ends[part + 1];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<std::uint32_t> order(slots.size());
  for (std::size_t i = 0; i < slots.size(); ++i) {
    order[ends[slots[i] / kSlotsOfPart]++] = static_cast<std::uint32_t>(i);
  }
  return order;
}

}  // namespace

PlaneTable::Interned PlaneTable::intern(Plane plane) {
  const bool turned = make_canonical(plane);
  if (2 * (interned_ + 1) > slots_.size()) grow_index();
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash_of(plane) & mask;
  while (slots_[slot].valid()) {
    if (same_coefficients(planes_[slots_[slot]], plane)) return {slots_[slot], turned};
    slot = (slot + 1) & mask;
  }
  slots_[slot] = planes_.push_back(plane);
  ++interned_;
  return {slots_[slot], turned};
}

PlaneId PlaneTable::find(const Plane& plane) const {
  MESHREPAIR_ASSERT(!slots_.empty());
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash_of(plane) & mask;
  while (slots_[slot].valid() && !same_coefficients(planes_[slots_[slot]], plane)) {
    slot = (slot + 1) & mask;
  }
  return slots_[slot];
}

std::vector<PlaneId> PlaneTable::take(IdVector<PlaneId, Plane> planes) {
  MESHREPAIR_ASSERT(planes_.empty());
  planes_ = std::move(planes);
  const std::vector<std::uint32_t> first = first_equal(
      planes_.size(), [&](std::size_t i) { return hash_of(planes_[PlaneId(i)]); },
      [&](std::size_t i, std::size_t j) {
        return same_coefficients(planes_[PlaneId(i)], planes_[PlaneId(j)]);
      });
  std::vector<PlaneId> ids(planes_.size());
  PlaneId next(0u);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (first[i] != i) {
      ids[i] = ids[first[i]];
      continue;
    }
    planes_[next] = planes_[PlaneId(i)];
    ids[i] = next;
    ++next.value;
  }
  planes_.resize(next.index());
  return ids;
}

void PlaneTable::reserve(std::size_t count) { planes_.reserve(count); }

void PlaneTable::release_index() {
  release(slots_);
  interned_ = 0;
}

// Part of the table by part: slots all over it, in no order, would be slow to reach, above all
// where the table is larger than the memory.
void PlaneTable::grow_index() {
  const std::size_t wanted = std::max<std::size_t>(64, 4 * (planes_.size() + 1));
  slots_.assign(std::bit_ceil(wanted), PlaneId());
  const std::size_t mask = slots_.size() - 1;
  std::vector<std::uint64_t> first_slots(planes_.size());
  parallel_for(planes_.size(),
               [&](std::size_t i) { first_slots[i] = hash_of(planes_[PlaneId(i)]) & mask; });
  for (const std::uint32_t i : in_parts_of_table(first_slots)) {
    std::size_t slot = first_slots[i];
    while (slots_[slot].valid()) slot = (slot + 1) & mask;
    slots_[slot] = PlaneId(i);
  }
  interned_ = planes_.size();
}

}  // namespace meshrepair
