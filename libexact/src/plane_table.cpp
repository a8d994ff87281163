// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <base/assert.h>
#include <base/buckets.h>
#include <base/first_equal.h>
#include <base/first_known.h>
#include <base/release.h>
#include <exact/plane_table.h>

namespace meshrepair {
namespace {

constexpr std::size_t kPartsOfTable = 256;  // a power of two, as its size is

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

// The planes of a table, and behind them canonical ones that may be new.
struct PlaneKeys {
  const IdVector<PlaneId, Plane>& known;
  const std::vector<Plane>& fresh;

  [[nodiscard]] const Plane& at(std::uint32_t i) const {
    return i < known.size() ? known[PlaneId(i)] : fresh[i - known.size()];
  }
  [[nodiscard]] std::uint64_t hash_of(std::uint32_t i) const { return meshrepair::hash_of(at(i)); }
  [[nodiscard]] bool same(std::uint32_t i, std::uint32_t j) const {
    return same_coefficients(at(i), at(j));
  }
};

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

std::vector<PlaneTable::Interned> PlaneTable::intern(std::vector<Plane> planes) {
  std::vector<Interned> interned;
  interned.reserve(planes.size());
  if (!slots_.empty()) {
    for (const Plane& plane : planes) interned.push_back(intern(plane));
    return interned;
  }
  for (Plane& plane : planes) interned.push_back({PlaneId(), make_canonical(plane)});
  const auto known = static_cast<std::uint32_t>(planes_.size());
  const std::vector<std::uint32_t> first =
      first_known(known, static_cast<std::uint32_t>(planes.size()), PlaneKeys{planes_, planes});
  planes_.reserve(known + count_fresh(first, known));
  for (std::uint32_t i = 0; i < planes.size(); ++i) {
    if (first[i] != known + i) {
      interned[i].id = first[i] < known ? PlaneId(first[i]) : interned[first[i] - known].id;
    } else {
      interned[i].id = planes_.push_back(planes[i]);
    }
  }
  return interned;
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
  struct Entry {
    PlaneId id;
    std::size_t slot;
  };
  const std::size_t parts = std::min(slots_.size(), kPartsOfTable);
  Buckets<Entry> buckets(planes_.size(), parts, [&](std::size_t i, const auto& put) {
    const std::size_t slot = hash_of(planes_[PlaneId(i)]) & mask;
    put(slot / (slots_.size() / parts), {PlaneId(i), slot});
  });
  for (std::size_t part = 0; part < parts; ++part) {
    for (auto [id, slot] : buckets[part]) {
      while (slots_[slot].valid()) slot = (slot + 1) & mask;
      slots_[slot] = id;
    }
  }
  interned_ = planes_.size();
}

}  // namespace meshrepair
