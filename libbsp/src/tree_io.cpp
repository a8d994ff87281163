// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include <base/atomic_file.h>
#include <base/file_bytes.h>
#include <bsp/tree_io.h>
#include <exact/predicates.h>
#include <mesh/packing.h>
#include <mesh/recognize_format.h>

#include "tree_sections.h"

namespace meshrepair {
namespace {

using internal::SectionReader;
using internal::SectionWriter;

constexpr std::uint32_t kVersion = 1;
constexpr std::uint32_t kSections = 7;

constexpr std::uint32_t kGridBytes = 32;
constexpr std::uint32_t kPointBytes = 36;
constexpr std::uint32_t kTriangleBytes = 24;
constexpr std::uint32_t kPlaneBytes = 40;
constexpr std::uint32_t kNodeBytes = 20;
constexpr std::uint32_t kNodeTriangleBytes = 4;
constexpr std::uint32_t kLeafBytes = 8;

// Of all triangles together, so that winding numbers stay far from the end of their range.
constexpr std::int64_t kMostLayers = std::int64_t{1} << 30;

void write_grid(const Grid& grid, std::string& out) {
  SectionWriter section(out, "GRID", kGridBytes, 1);
  for (int axis = 0; axis < 3; ++axis) section.put(grid.origin[axis]);
  section.put(grid.unit);
  section.finish();
}

void write_points(const CleanSoup& soup, std::string& out) {
  SectionWriter section(out, "PNTS", kPointBytes, soup.points.size());
  for (PointId p(0u); p < soup.points.end_id(); ++p.value) {
    for (int axis = 0; axis < 3; ++axis) section.put(soup.points[p][axis]);
    const GridPoint& g = soup.grid_points[p];
    for (const std::int32_t x : {g.x, g.y, g.z}) section.put(x);
  }
  section.finish();
}

void write_triangles(const CleanSoup& soup, std::string& out) {
  SectionWriter section(out, "TRIS", kTriangleBytes, soup.triangles.size());
  for (const Triangle& t : soup.triangles) {
    for (const PointId corner : t.corners) section.put(corner.value);
    section.put(t.plane.value);
    section.put(t.winding * t.layers);
    section.put(t.source);
  }
  section.finish();
}

void write_planes(const PlaneTable& planes, std::string& out) {
  SectionWriter section(out, "PLNS", kPlaneBytes, planes.size());
  for (PlaneId p(0u); p.index() < planes.size(); ++p.value) {
    const Plane& plane = planes[p];
    for (const std::int64_t n : plane.normal) section.put(n);
    section.put(static_cast<std::uint64_t>(plane.offset));
    section.put(static_cast<std::int64_t>(plane.offset >> 64));
  }
  section.finish();
}

void write_nodes(const Tree& tree, std::string& out) {
  SectionWriter section(out, "NODE", kNodeBytes, tree.nodes.size());
  for (const TreeNode& node : tree.nodes) {
    section.put(node.plane.value);
    for (const TreeRef child : node.child) section.put(child.bits());
    section.put(node.first_triangle);
    section.put(node.triangle_count);
  }
  section.finish();
  SectionWriter triangles(out, "NTRI", kNodeTriangleBytes, tree.node_triangles.size());
  for (const TriangleId t : tree.node_triangles) triangles.put(t.value);
  triangles.finish();
}

void write_leaves(const Tree& tree, std::string& out) {
  SectionWriter section(out, "LEAF", kLeafBytes, tree.leaves.size());
  for (const Leaf& leaf : tree.leaves) {
    section.put(static_cast<std::uint32_t>(leaf.label));
    section.put(leaf.confidence);
  }
  section.finish();
}

bool is_power_of_two(double x) {
  int exponent = 0;
  return std::isfinite(x) && x > 0 && std::frexp(x, &exponent) == 0.5;
}

void read_grid(SectionReader& in, Grid& grid) {
  in.require(in.enter("GRID", kGridBytes) == 1, "does not have exactly one item");
  for (int axis = 0; axis < 3; ++axis) grid.origin[axis] = in.get<double>();
  grid.unit = in.get<double>();
  in.require(grid.origin.allFinite() && is_power_of_two(grid.unit), "is no grid");
}

void read_points(SectionReader& in, CleanSoup& soup) {
  const std::size_t count = in.enter("PNTS", kPointBytes);
  soup.points.reserve(count);
  soup.grid_points.reserve(count);
  const auto in_grid = [](std::int32_t x) { return x >= -kGridRadius && x <= kGridRadius; };
  for (std::size_t i = 0; i < count; ++i) {
    in.tick();
    Vec3d at;
    for (int axis = 0; axis < 3; ++axis) at[axis] = in.get<double>();
    GridPoint g;
    for (std::int32_t* x : {&g.x, &g.y, &g.z}) *x = in.get<std::int32_t>();
    in.require(at.allFinite(), "has a point that is not finite");
    in.require(in_grid(g.x) && in_grid(g.y) && in_grid(g.z), "has a point outside the grid");
    // Decisions are made on the grid, but these coordinates are written.
    in.require(soup.grid.to_grid(at) == g, "has a point that is not at its place on the grid");
    soup.points.push_back(at);
    soup.grid_points.push_back(g);
  }
}

void read_triangles(SectionReader& in, CleanSoup& soup) {
  const std::size_t count = in.enter("TRIS", kTriangleBytes);
  in.require_at_most(count);
  soup.triangles.reserve(count);
  std::int64_t layers = 0;
  for (std::size_t i = 0; i < count; ++i) {
    in.tick();
    Triangle t;
    for (PointId& corner : t.corners) {
      corner = PointId(in.get<std::uint32_t>());
      in.require(soup.points.contains(corner), "refers to a point that is not there");
    }
    t.plane = PlaneId(in.get<std::uint32_t>());
    const auto winding = in.get<std::int32_t>();
    const std::int64_t all = std::abs(std::int64_t{winding});
    layers += all;
    in.require(layers <= kMostLayers, "has a winding beyond all bounds");
    t.winding = winding > 0 ? 1 : winding < 0 ? -1 : 0;
    t.layers = static_cast<std::int32_t>(std::max(std::int64_t{1}, all));
    t.source = in.get<std::uint32_t>();
    soup.triangles.push_back(t);
  }
}

void read_planes(SectionReader& in, PlaneTable& planes) {
  const std::size_t count = in.enter("PLNS", kPlaneBytes);
  planes.reserve(count);
  constexpr std::int64_t kNormalLimit = std::int64_t{1} << 54;
  constexpr Int128 kOffsetLimit = Int128{1} << 81;
  for (std::size_t i = 0; i < count; ++i) {
    in.tick();
    Plane plane;
    for (std::int64_t& n : plane.normal) {
      n = in.get<std::int64_t>();
      in.require(n > -kNormalLimit && n < kNormalLimit, "has a normal out of range");
    }
    const auto low = in.get<std::uint64_t>();
    const auto high = in.get<std::int64_t>();
    plane.offset = static_cast<Int128>((static_cast<Uint128>(high) << 64) | low);
    in.require(plane.offset > -kOffsetLimit && plane.offset < kOffsetLimit,
               "has an offset out of range");
    in.require(!is_null(plane), "has a plane without a normal");
    planes.append(make_plane(plane.normal, plane.offset));
  }
}

// Triangles stand before the planes they refer to, so they are held against them here.
void check_triangles(const SectionReader& in, const CleanSoup& soup) {
  for (const Triangle& t : soup.triangles) {
    in.require(soup.planes.contains(t.plane), "lacks a plane that a triangle refers to");
    const auto& at = soup.grid_points;
    in.require(!is_null(plane_through(at[t.corners[0]], at[t.corners[1]], at[t.corners[2]])),
               "belongs to a degenerate triangle");
    for (const PointId corner : t.corners) {
      in.require(side(at[corner], soup.planes[t.plane]) == 0,
                 "has a plane that does not hold its triangle");
    }
  }
}

void read_nodes(SectionReader& in, Tree& tree) {
  const std::size_t count = in.enter("NODE", kNodeBytes);
  tree.nodes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    in.tick();
    TreeNode node;
    node.plane = PlaneId(in.get<std::uint32_t>());
    for (TreeRef& child : node.child) child = TreeRef::from_bits(in.get<std::uint32_t>());
    node.first_triangle = in.get<std::uint32_t>();
    node.triangle_count = in.get<std::uint32_t>();
    in.require(tree.input.planes.contains(node.plane), "refers to a plane that is not there");
    tree.nodes.push_back(node);
  }
  tree.root = count > 0 ? TreeRef(NodeId(0u)) : TreeRef(LeafId(0u));
}

// Each child comes later than its parent and is referred to once, so there is no cycle; leaves
// likewise.
void check_structure(const SectionReader& in, const Tree& tree, std::size_t leaves) {
  std::vector<char> node_seen(tree.nodes.size(), 0);
  std::vector<char> leaf_seen(leaves, 0);
  for (NodeId n(0u); n < tree.nodes.end_id(); ++n.value) {
    for (const TreeRef child : tree.nodes[n].child) {
      if (child.is_leaf()) {
        in.require(child.leaf().index() < leaves, "refers to a leaf that is not there");
        in.require(leaf_seen[child.leaf().index()]++ == 0, "refers to a leaf twice");
      } else {
        in.require(tree.nodes.contains(child.node()), "refers to a node that is not there");
        in.require(n < child.node(), "has a child before its parent");
        in.require(node_seen[child.node().index()]++ == 0, "refers to a node twice");
      }
    }
  }
}

void read_node_triangles(SectionReader& in, Tree& tree) {
  const std::size_t count = in.enter("NTRI", kNodeTriangleBytes);
  tree.node_triangles.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    in.tick();
    const TriangleId t(in.get<std::uint32_t>());
    in.require(tree.input.triangles.contains(t), "refers to a triangle that is not there");
    tree.node_triangles.push_back(t);
  }
  for (const TreeNode& node : tree.nodes) {
    const std::size_t end = std::size_t{node.first_triangle} + node.triangle_count;
    in.require(end <= count, "is shorter than a node says");
    for (std::size_t i = node.first_triangle; i < end; ++i) {
      in.require(tree.input.triangles[tree.node_triangles[i]].plane == node.plane,
                 "puts a triangle at a node with another plane");
    }
  }
}

void read_leaves(SectionReader& in, Tree& tree) {
  const std::size_t count = in.enter("LEAF", kLeafBytes);
  in.require(count == tree.nodes.size() + 1, "does not have one leaf more than there are nodes");
  check_structure(in, tree, count);
  tree.leaves.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    in.tick();
    const auto label = in.get<std::uint32_t>();
    const auto confidence = in.get<float>();
    in.require(label <= 2, "has an unknown label");
    in.require(confidence >= 0 && confidence <= 1, "has a confidence outside 0 to 1");
    tree.leaves.push_back({static_cast<Label>(label), confidence});
  }
}

std::string why_no_tree(std::string_view bytes) {
  if (bytes.empty()) return "is empty";
  if (recognize_content(bytes)) return "is a mesh, not a BSP tree: run bspbuild on it first";
  return "is not a .bsp file";
}

}  // namespace

std::string format_tree(const Tree& tree) {
  std::string out(kTreeSignature);
  internal::put_number(out, kVersion);
  internal::put_number(out, kSections);
  write_grid(tree.input.grid, out);
  write_points(tree.input, out);
  write_triangles(tree.input, out);
  write_planes(tree.input.planes, out);
  write_nodes(tree, out);
  write_leaves(tree, out);
  return out;
}

Tree parse_tree(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  const MeshSource source = {bytes, name, options};
  SectionReader in(source);
  in.skip(kTreeSignature, bytes.starts_with(kTreeSignature) ? std::string() : why_no_tree(bytes));
  const std::uint32_t version = in.header_number();
  if (version != kVersion) {
    in.fail("has version " + std::to_string(version) + "; this program reads version " +
            std::to_string(kVersion));
  }
  in.require(in.header_number() == kSections, "has another number of sections");
  Tree tree;
  read_grid(in, tree.input.grid);
  read_points(in, tree.input);
  read_triangles(in, tree.input);
  read_planes(in, tree.input.planes);
  check_triangles(in, tree.input);
  read_nodes(in, tree);
  read_node_triangles(in, tree);
  read_leaves(in, tree);
  in.require(in.at_end(), "is followed by more bytes");
  return tree;
}

void write_tree(const Tree& tree, const std::filesystem::path& path, ProgressObserver* progress) {
  const Packing packing = packing_of_extension(path);
  std::string bytes = format_tree(tree);
  if (packing != Packing::none) bytes = pack_bytes(bytes, packing, progress);
  write_file_atomically(path, bytes, progress);
}

Tree read_tree(const std::filesystem::path& path, const ReadOptions& options) {
  const FileBytes file(path, options.progress);
  const std::string name = path == "-" ? "standard input" : path.string();
  const Packing packing = packing_of_content(file.bytes());
  if (packing != Packing::gzip && packing != Packing::zstd) {
    return parse_tree(file.bytes(), name, options);
  }
  CancelOnly cancel_only(options.progress);
  ReadOptions unpacking;
  unpacking.progress = &cancel_only;
  std::vector<Warning> warnings;  // a tree is followed by nothing
  const TrivialVector<char> bytes = unpack({file.bytes(), name, unpacking}, packing, warnings);
  if (!warnings.empty()) throw InputError(name + ": is followed by " + warnings.front().text);
  return parse_tree({bytes.begin(), bytes.size()}, name, options);
}

}  // namespace meshrepair
