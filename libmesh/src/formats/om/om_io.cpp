// SPDX-License-Identifier: MIT
// OpenMesh's own format, little endian, read without OpenMesh: its reader follows broken files into
// aborts, crashes and indices out of range.
//
//   "OM", char 'T' | 'Q' | 'P', uint8 version (3 bits major, 5 bits minor), uint32 vertices, faces,
//   edges chunks: uint16 kind, [uint8 length, name], data
//
// A kind has, from its lowest bit: 1 reserved, 1 named, 3 entity, 4 type, 1 signed, 1 float, 3
// dimension less one, 2 size (1 << size bytes for integers, 4 << size for floats). Of the data we
// need the positions of the vertices and the topology. That is, before version 2, the corners of
// each face, after a uint16 with their number in a mesh of kind 'P'; since then, for each halfedge,
// its next one, its vertex and its face, and for each face one of its halfedges. Ids are signed.
// Chunks with properties of users come last.
#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <base/byte_order.h>
#include <base/file_bytes.h>
#include <mesh/mesh_source.h>
#include <mesh/openmesh.h>

#include "formats/common/face_list.h"

namespace meshrepair {
namespace {

enum class Entity { vertex = 0, mesh = 1, face = 2, edge = 4, halfedge = 6, sentinel = 7 };
enum class Type { position = 0, custom = 6, topology = 7 };

struct Chunk {
  bool named = false;
  Entity entity = Entity::sentinel;
  int type = 0;
  bool is_float = false;
  std::size_t dimension = 1;
  std::size_t value_size = 1;

  [[nodiscard]] bool is(Type wanted) const { return type == static_cast<int>(wanted); }
};

Chunk decode(unsigned bits) {
  const auto field = [&](unsigned at, unsigned width) { return bits >> at & ((1u << width) - 1); };
  Chunk chunk;
  chunk.named = field(1, 1) != 0;
  chunk.entity = static_cast<Entity>(field(2, 3));
  chunk.type = static_cast<int>(field(5, 4));
  chunk.is_float = field(10, 1) != 0;
  chunk.dimension = field(11, 3) + 1;
  // The flag of topology chunks is that of the chunk before.
  const bool floats = chunk.is_float && !chunk.is(Type::topology);
  chunk.value_size = std::size_t{floats ? 4u : 1u} << field(14, 2);
  return chunk;
}

class OmReader {
 public:
  explicit OmReader(const MeshSource& source) : source_(source) {}

  TriangleSoup run() {
    read_header();
    while (!done_ && source_.bytes.size() - at_ >= 2) read_chunk();
    if (!has_faces_) source_.fail("the .om file ends before its faces");
    faces_.append_to(result_, source_.options.progress);
    if (!result_.report.warnings.empty()) source_.fail(result_.report.warnings.front().text);
    if (result_.soup.triangles.empty()) source_.fail("holds no triangles");
    return std::move(result_.soup);
  }

 private:
  struct Halfedge {
    std::int64_t next = -1;
    std::int64_t to = -1;
  };

  void need(std::size_t count, std::size_t size) const {
    if (count > (source_.bytes.size() - at_) / size) source_.fail("the .om file is cut");
  }

  template <class Number>
  Number take() {
    need(1, sizeof(Number));
    const char* bytes = source_.bytes.data() + at_;
    at_ += sizeof(Number);
    return load<Number>(bytes, std::endian::little);
  }

  std::int64_t take_id(std::size_t size) {
    switch (size) {
      case 1:
        return take<std::int8_t>();
      case 2:
        return take<std::int16_t>();
      case 4:
        return take<std::int32_t>();
      default:
        return take<std::int64_t>();
    }
  }

  void skip(std::size_t count, std::size_t size) {
    need(count, size);
    at_ += count * size;
  }

  void read_header() {
    if (!source_.bytes.starts_with("OM")) source_.fail("is no .om file: it does not begin with OM");
    skip(2, 1);
    kind_ = take<char>();
    if (kind_ != 'T' && kind_ != 'Q' && kind_ != 'P') source_.fail("an .om file of unknown kind");
    major_version_ = take<std::uint8_t>() >> 5;
    if (major_version_ > 2) source_.fail("an .om file of a version later than 2");
    vertices_ = take<std::uint32_t>();
    face_count_ = take<std::uint32_t>();
    edges_ = take<std::uint32_t>();
  }

  void read_chunk() {
    const Chunk chunk = decode(take<std::uint16_t>());
    if (chunk.named) skip(take<std::uint8_t>(), 1);
    if (chunk.entity == Entity::sentinel || has_faces_) {
      done_ = true;
    } else if (chunk.is(Type::custom)) {
      skip(take<std::uint32_t>(), 1);
    } else if (chunk.is(Type::position) && chunk.entity == Entity::vertex) {
      read_points(chunk);
    } else if (chunk.is(Type::topology) && chunk.entity == Entity::halfedge) {
      read_halfedges(chunk);
    } else if (chunk.is(Type::topology) && chunk.entity == Entity::face) {
      has_faces_ = true;
      major_version_ < 2 ? read_corners(chunk) : read_faces(chunk);
    } else {
      const std::size_t dimension = chunk.is(Type::topology) ? 1 : chunk.dimension;
      skip(count_of(chunk.entity), dimension * chunk.value_size);
    }
  }

  [[nodiscard]] std::size_t count_of(Entity entity) const {
    switch (entity) {
      case Entity::vertex:
        return vertices_;
      case Entity::face:
        return face_count_;
      case Entity::edge:
        return edges_;
      case Entity::halfedge:
        return 2 * edges_;
      case Entity::mesh:
        return 1;
      default:
        source_.fail("a chunk of unknown kind in the .om file");
    }
  }

  void read_points(const Chunk& chunk) {
    const bool is_double = chunk.value_size == sizeof(double);
    if (!chunk.is_float || chunk.dimension != 3 || chunk.value_size > sizeof(double)) {
      source_.fail("the points of the .om file are not three floats or doubles");
    }
    need(vertices_, 3 * chunk.value_size);
    result_.soup.points.resize(vertices_);
    for (Vec3d& point : result_.soup.points) {
      for (double& value : point) value = is_double ? take<double>() : double{take<float>()};
    }
  }

  void read_halfedges(const Chunk& chunk) {
    need(2 * edges_, 3 * chunk.value_size);
    halfedges_.resize(2 * edges_);
    for (Halfedge& halfedge : halfedges_) {
      halfedge.next = take_id(chunk.value_size);
      halfedge.to = take_id(chunk.value_size);
      skip(1, chunk.value_size);
    }
  }

  void read_corners(const Chunk& chunk) {
    for (std::size_t face = 0; face < face_count_; ++face) {
      std::size_t corners = kind_ == 'T' ? 3 : 4;
      if (kind_ == 'P') corners = take<std::uint16_t>();
      faces_.begin_face();
      for (; corners > 0; --corners) faces_.add_corner(take_id(chunk.value_size));
      faces_.end_face();
    }
  }

  // A halfedge belongs to one face: each is used up by the face that reaches it, which also ends
  // the walk along halfedges that never return.
  void read_faces(const Chunk& chunk) {
    for (std::size_t face = 0; face < face_count_; ++face) {
      faces_.begin_face();
      std::int64_t at = take_id(chunk.value_size);
      const std::int64_t start = at;
      do {
        if (at < 0 || static_cast<std::size_t>(at) >= halfedges_.size()) fail_at_face(face);
        Halfedge& halfedge = halfedges_[static_cast<std::size_t>(at)];
        faces_.add_corner(halfedge.to);
        at = std::exchange(halfedge.next, -1);
      } while (at != start);
      faces_.end_face();
    }
  }

  [[noreturn]] void fail_at_face(std::size_t face) const {
    source_.fail("the halfedges of face " + std::to_string(face) + " of the .om file form no loop");
  }

  const MeshSource& source_;
  std::size_t at_ = 0;
  char kind_ = 'T';
  int major_version_ = 0;
  std::size_t vertices_ = 0;
  std::size_t face_count_ = 0;
  std::size_t edges_ = 0;
  std::vector<Halfedge> halfedges_;
  FaceList faces_;
  ReadResult result_;
  bool has_faces_ = false;
  bool done_ = false;
};

}  // namespace

TriangleSoup read_om(const std::filesystem::path& path) {
  const FileBytes file(path);
  const MeshSource source = {file.bytes(), path.string()};
  return OmReader(source).run();
}

}  // namespace meshrepair
