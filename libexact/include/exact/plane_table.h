// SPDX-License-Identifier: MIT
// All planes of a tree, each once.
#pragma once

#include <cstddef>
#include <vector>

#include <base/ids.h>
#include <exact/plane.h>

namespace meshrepair {

class PlaneTable {
 public:
  struct Interned {
    PlaneId id;
    bool turned = false;  // the stored plane's normal points the other way
  };

  // The id of the plane with these points, made canonical; a new one if it is not there yet. Ids
  // count up from 0. `plane` has a normal that is not zero. Amortised constant time.
  Interned intern(Plane plane);
  // The same for several, as one by one would give. What is there already is read in order, and no
  // look-up table of it is made: for a few planes and a table of many.
  [[nodiscard]] std::vector<Interned> intern(std::vector<Plane> planes);

  // The id of a canonical plane; invalid if it is not there. Only between intern() and
  // release_index().
  [[nodiscard]] PlaneId find(const Plane& plane) const;

  // The id of each of these canonical planes, as interning them one by one would give. The table is
  // empty before. On several threads.
  [[nodiscard]] std::vector<PlaneId> take(IdVector<PlaneId, Plane> planes);

  // Adds a plane under a new id without looking whether it is there: for planes that are never
  // compared.
  PlaneId append(const Plane& plane) { return planes_.push_back(plane); }

  const Plane& operator[](PlaneId id) const { return planes_[id]; }
  [[nodiscard]] std::size_t size() const { return planes_.size(); }
  [[nodiscard]] bool contains(PlaneId id) const { return planes_.contains(id); }
  void reserve(std::size_t count);
  // Drops the look-up table; interning again builds it anew from all planes.
  void release_index();

 private:
  void grow_index();

  IdVector<PlaneId, Plane> planes_;
  std::vector<PlaneId> slots_;  // open addressing, a power of two long, at most half full
  std::size_t interned_ = 0;
};

}  // namespace meshrepair
