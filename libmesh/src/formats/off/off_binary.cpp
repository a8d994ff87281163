// SPDX-License-Identifier: MIT
// Binary OFF, big endian, after a keyword line as in the text ("OFF BINARY"):
//
//   [int32 dimension]                                      if the keyword has an n
//   int32 points, int32 faces, int32 edges
//   float32 x 3, [w], [normal x 3], [colour x 4], [texture x 2]    for each point
//   int32 n, int32 x n, int32 c, float32 x c               for each face, colour of c components
#include <algorithm>
#include <bit>

#include <base/byte_order.h>
#include <mesh/read_guard.h>

#include "formats/common/face_list.h"
#include "off_header.h"
#include "off_io.h"

namespace meshrepair {
namespace {

constexpr std::size_t kWord = 4;

class BinaryOffReader {
 public:
  explicit BinaryOffReader(const MeshSource& source)
      : source_(source), header_(read_off_header(source)), at_(header_.data_at), guard_(source) {}

  ReadResult run() {
    result_.report.format = SoupFormat::off;
    read_counts();
    read_points();
    while (faces_.size() < header_.faces && read_face()) {
      guard_.step(faces_.triangles(), at_);
    }
    guard_.step(faces_.triangles(), source_.bytes.size());
    report_losses();
    faces_.append_to(result_, source_.options.progress);
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::size_t words_left() const { return (source_.bytes.size() - at_) / kWord; }

  template <class Number>
  Number take() {
    const char* bytes = source_.bytes.data() + at_;
    at_ += kWord;
    return load<Number>(bytes, std::endian::big);
  }

  void read_counts() {
    if (words_left() < (header_.dimension ? 4u : 3u)) source_.fail("a binary OFF without counts");
    if (header_.dimension && take<std::int32_t>() != 3) {
      source_.fail("only points with three coordinates can be read");
    }
    header_.points = take<std::uint32_t>();
    header_.faces = take<std::uint32_t>();
    at_ += kWord;
    result_.report.declared_triangles = header_.faces;
  }

  void read_points() {
    const std::size_t stride = header_.numbers_per_point();
    const std::size_t count = within(header_.points, words_left() / stride);
    result_.soup.points.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      guard_.step(0, at_);
      const std::size_t next = at_ + stride * kWord;
      const float x = take<float>();
      const float y = take<float>();
      const float z = take<float>();
      const double scale = header_.homogeneous ? take<float>() : 1.0;
      result_.soup.points.push_back(Vec3d(x, y, z) / scale);
      at_ = next;
    }
  }

  // False when the rest of the file does not hold the face. There is no way to find the next one
  // then.
  bool read_face() {
    const std::size_t start = at_;
    if (words_left() == 0) return false;
    const std::size_t corners = take<std::uint32_t>();
    if (corners >= words_left()) return give_up(start);
    faces_.begin_face();
    for (std::size_t i = 0; i < corners; ++i) faces_.add_corner(take<std::int32_t>());
    faces_.end_face();
    const std::size_t colors = take<std::uint32_t>();
    if (colors > words_left()) return give_up(at_);
    at_ += colors * kWord;
    return true;
  }

  bool give_up(std::size_t start) {
    at_ = start;
    return false;
  }

  void report_losses() {
    ReadReport& report = result_.report;
    const std::size_t points = result_.soup.points.size();
    report.missing_faces = header_.faces - faces_.size();
    report.trailing_bytes = source_.bytes.size() - at_;
    if (points < header_.points || report.missing_faces > 0) {
      report.warnings.push_back({WarningCode::file_cut_off,
                                 "the header promises " + counted(header_.points, "point") +
                                     " and " + counted(header_.faces, "face") +
                                     ", the file holds " + std::to_string(points) + " and " +
                                     std::to_string(faces_.size()),
                                 {{"promised", header_.faces}, {"found", faces_.size()}}});
    }
    if (report.trailing_bytes > 0) {
      report.warnings.push_back(bytes_ignored(report.trailing_bytes, "after the last whole face"));
    }
  }

  const MeshSource& source_;
  OffHeader header_;
  std::size_t at_;
  ReadResult result_;
  FaceList faces_;
  ReadGuard guard_;
};

}  // namespace

ReadResult read_off_binary(const MeshSource& source) { return BinaryOffReader(source).run(); }

}  // namespace meshrepair
