// SPDX-License-Identifier: MIT
// The convex pieces into which the tree's planes cut the input triangles while the tree is built.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bsp/clean_soup.h>
#include <exact/point.h>

namespace meshrepair::internal {

using FragmentId = Id<struct FragmentTag>;

// A corner and the edge from it to the next corner; the edge lies in the fragment's plane and in
// `edge`.
struct Corner {
  Point point;
  PlaneId edge;  // kOriginalEdge + k: edge k of the input triangle, whose plane is made when needed
};

// A convex polygon in the plane of its triangle, the triangle's orientation or the reverse.
struct Fragment {
  TriangleId triangle;
  PlaneId plane;
  std::uint32_t first = 0;  // corner block
  std::uint32_t count = 0;
  std::array<float, 3> low{}, high{};  // bounding box, for choosing planes only
};

class FragmentPool {
 public:
  // One fragment for each triangle, in their order.
  explicit FragmentPool(const CleanSoup& soup);
  // Copies of these fragments, in this order, with those planes alone that they refer to. Names
  // planes in the same order.
  FragmentPool(const FragmentPool& other, std::span<const FragmentId> fragments);

  struct Pieces {
    FragmentId front, back;  // invalid where there is none; both invalid: lost
  };

  // Cuts by a plane of planes() that is not the fragment's own; a fragment that is not cut keeps
  // its id, one that is cut is given back and replaced by two new ones.
  Pieces split(FragmentId id, PlaneId by);

  // Forgets a fragment whose place is final.
  void release(FragmentId id);

  const Fragment& operator[](FragmentId id) const { return fragments_[id.index()]; }
  [[nodiscard]] const Corner* corners(const Fragment& f) const { return &corners_[f.first]; }
  [[nodiscard]] std::size_t size() const { return fragments_.size(); }

  // The planes that fragments refer to: those of the soup, which have other ids here, then planes
  // of edges and whatever add_plane() was given.
  [[nodiscard]] const PlaneTable& planes() const { return planes_; }
  PlaneId add_plane(const Plane& plane) { return planes_.append(plane); }
  // The id in the soup of a plane of it, and the other way round: invalid if none is in it.
  [[nodiscard]] PlaneId soup_plane(PlaneId plane) const;
  [[nodiscard]] PlaneId find(PlaneId soup_plane) const;

 private:
  FragmentId new_fragment(const Fragment& parent, const std::vector<Corner>& corners);
  std::uint32_t take_block(std::uint32_t count);
  [[nodiscard]] Plane plane_of_edge(TriangleId triangle, PlaneId edge) const;
  void rename_planes(const FragmentPool& other);
  Point cut_edge(const Fragment& f, Corner& from, const Corner& to, PlaneId by);
  void set_bounds(Fragment& f) const;

  const CleanSoup& soup_;
  PlaneTable planes_;
  // In the soup, of the first planes, which are of it; empty: all have the same ids here.
  std::vector<PlaneId> soup_plane_ids_;
  TrivialVector<Fragment> fragments_;
  std::vector<FragmentId> free_fragments_;
  TrivialVector<Corner> corners_;
  std::vector<std::vector<std::uint32_t>> free_blocks_;  // by number of corners
  std::vector<int> sides_;                               // scratch
  std::vector<Corner> front_, back_;                     // scratch
};

}  // namespace meshrepair::internal
