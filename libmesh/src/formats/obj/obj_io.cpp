// SPDX-License-Identifier: MIT
#include "obj_io.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string_view>

#include <mesh/read_guard.h>

#include "formats/common/face_list.h"
#include "formats/common/plain_lines.h"
#include "formats/common/text_scanner.h"
#include "formats/common/text_writer.h"
#include "material_library.h"
#include "obj_attributes.h"

namespace meshrepair {
namespace {

constexpr TextDialect kObjText = {.comment = '#', .continuation = true};

// What a mesh can have besides faces: lines, points, curves, surfaces, and files that are put in.
bool is_no_face(std::string_view word) {
  constexpr std::array<std::string_view, 6> kWords = {"l", "p", "curv", "curv2", "surf", "call"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

class ObjReader {
 public:
  explicit ObjReader(const MeshSource& source)
      : source_(source), text_(source.bytes, kObjText), guard_(source) {}

  ReadResult run() {
    result_.report.format = SoupFormat::obj;
    while (text_.next_anywhere()) {
      line_at_ = text_.position();
      guard_.step(faces_.triangles(), line_at_);
      const std::string_view word = text_.peek_token();
      if (read_plain(word)) continue;
      text_.skip_token();
      if (word == "v") {
        read_point();
      } else if (word == "f" || word == "fo") {  // fo: face outline of old versions
        read_face();
      } else if (!(wants_attributes() && attributes_.read_line(word, text_)) && is_no_face(word)) {
        ++left_out_;
      }
      text_.skip_line();
    }
    guard_.step(faces_.triangles(), source_.bytes.size());
    warn_of_bad(result_.report, source_, first_bad_, "face", "corners that are not numbers");
    if (left_out_ > 0) {
      result_.report.warnings.push_back(
          {WarningCode::content_ignored,
           counted(left_out_, "element") + " left out: lines, points, curves or surfaces",
           {{"elements", left_out_}}});
    }
    if (wants_attributes()) {
      std::vector<FaceList::Origin> origins;
      faces_.append_to(result_, source_.options.progress, &origins);
      result_.attributes = attributes_.take(origins, result_.soup.triangles);
      warn_of_bad_corners();
      read_material_libraries(source_, attributes_.libraries(), result_.attributes, result_.report);
    } else {
      faces_.append_to(result_, source_.options.progress);
    }
    return std::move(result_);
  }

 private:
  // In files in which lines that look plain are not, it is not worth while to try each.
  static constexpr std::size_t kMostMisses = 100;

  [[nodiscard]] bool wants_attributes() const { return source_.options.attributes; }

  void warn_of_bad_corners() {
    const std::size_t bad = attributes_.bad_corners();
    if (bad == 0) return;
    result_.report.warnings.push_back(
        {WarningCode::attributes_unreadable,
         std::to_string(bad) + (bad == 1 ? " corner names" : " corners name") +
             " texture coordinates or normals that are not there: left without",
         {{"corners", bad}}});
  }

  // Lines that have nothing odd about them, if such ones come here. False: they do not.
  bool read_plain(std::string_view word) {
    if (plain_misses_ == kMostMisses || (word != "v" && word != "f")) return false;
    text_.go_to(word == "v" ? read_plain_points() : read_plain_faces());
    if (text_.position() != line_at_) return true;
    ++plain_misses_;
    return false;
  }

  std::size_t read_plain_points() {
    const auto parse = [](PlainLine& line, Vec3d& p) {
      return line.letter('v') && line.blanks() && line.number(p[0]) && line.blanks() &&
             line.number(p[1]) && line.blanks() && line.number(p[2]) && line.ends();
    };
    const auto take = [&](std::span<const Vec3d> points, std::size_t position) {
      for (const Vec3d& p : points) {
        guard_.step(faces_.triangles(), position);
        result_.soup.points.push_back(p);
      }
      return points.size();
    };
    return read_plain_lines<Vec3d>(source_.bytes, text_.position(), parse, take);
  }

  // A triangle of points that are counted from the first one, and where its corners begin and end,
  // from `line` on.
  struct PlainFace {
    const char* line = nullptr;
    std::array<std::uint32_t, 3> numbers{};
    std::array<std::uint8_t, 3> first{}, last{};
  };

  static bool parse_corner(PlainLine& line, PlainFace& face, std::size_t k) {
    constexpr std::ptrdiff_t kMostBytes = std::numeric_limits<std::uint8_t>::max();
    const bool has_blanks = line.blanks();
    const std::ptrdiff_t first = line.at() - face.line;
    if (!has_blanks || !line.number(face.numbers[k]) || face.numbers[k] == 0) return false;
    if (line.letter('/') && !line.token()) return false;
    const std::ptrdiff_t last = line.at() - face.line;
    face.first[k] = static_cast<std::uint8_t>(first);
    face.last[k] = static_cast<std::uint8_t>(last);
    return last <= kMostBytes;
  }

  std::size_t read_plain_faces() {
    const auto parse = [](PlainLine& line, PlainFace& face) {
      face.line = line.at();
      return line.letter('f') && parse_corner(line, face, 0) && parse_corner(line, face, 1) &&
             parse_corner(line, face, 2) && line.ends();
    };
    const auto take = [&](std::span<const PlainFace> faces, std::size_t position) {
      const std::size_t room = source_.options.max_triangles - faces_.triangles();
      const std::size_t count = std::min(faces.size(), room);
      for (const PlainFace& face : faces.first(count)) {
        guard_.step(faces_.triangles(), position);
        take_plain_face(face);
      }
      return count;
    };
    return read_plain_lines<PlainFace>(source_.bytes, text_.position(), parse, take);
  }

  void take_plain_face(const PlainFace& face) {
    const auto& [a, b, c] = face.numbers;
    faces_.add_triangle({a - 1, b - 1, c - 1});
    if (!wants_attributes()) return;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto length = static_cast<std::size_t>(face.last[k] - face.first[k]);
      attributes_.add_corner({face.line + face.first[k], length});
    }
    attributes_.end_face();
  }

  void read_point() {
    Vec3d point = Vec3d::Constant(std::numeric_limits<double>::quiet_NaN());
    bool good = true;
    for (int i = 0; i < 3; ++i) good = text_.next_on_line() && text_.read_real(point[i]) && good;
    if (!good && result_.report.bad_points++ == 0) first_bad_.point = line_at_;
    result_.soup.points.push_back(point);
    if (wants_attributes()) attributes_.read_colour(text_, result_.soup.points.size());
  }

  void read_face() {
    faces_.begin_face();
    while (text_.next_on_line()) {
      std::int64_t number = 0;
      if (wants_attributes()) attributes_.add_corner(text_.peek_token());
      if (!text_.read_integer(number, '/')) {
        if (result_.report.bad_faces++ == 0) first_bad_.face = line_at_;
        faces_.drop_face();
        if (wants_attributes()) attributes_.keep_corners(faces_.corners());
        return;
      }
      faces_.add_corner(index_of(number));
    }
    faces_.end_face();
    if (wants_attributes()) attributes_.end_face();
  }

  [[nodiscard]] std::int64_t index_of(std::int64_t number) const {
    if (number > 0) return number - 1;
    if (number == 0) return FaceList::kNoPoint;
    return static_cast<std::int64_t>(result_.soup.points.size()) + number;
  }

  const MeshSource& source_;
  TextScanner text_;
  ReadResult result_;
  FaceList faces_;
  ObjAttributes attributes_;
  ReadGuard guard_;
  std::size_t line_at_ = 0, left_out_ = 0;
  std::size_t plain_misses_ = 0;
  FirstBad first_bad_;
};

// `library` is the name of the file that has the materials; empty: there is none.
std::string text_of_obj(const TriangleSoup& soup, const SoupExtras& extras,
                        const std::string& library) {
  std::string out;
  for (const std::string& comment : extras.comments) out += "# " + comment + "\n";
  if (extras.attributes != nullptr && !extras.attributes->empty()) {
    out += library.empty() ? std::string() : "mtllib " + library + "\n";
    out += unread_libraries(*extras.attributes);
    append_obj(out, soup, *extras.attributes);
    return out;
  }
  append_lines(out, soup.points.size(), [&](std::string& lines, std::size_t p) {
    lines += "v ";
    append_triple(lines, soup.points[p]);
    lines += '\n';
  });
  append_lines(out, soup.triangles.size(), [&](std::string& lines, std::size_t t) {
    const auto& [a, b, c] = soup.triangles[t];
    lines += "f ";
    append_triple(lines, std::array<std::uint64_t, 3>{a + 1ull, b + 1ull, c + 1ull});
    lines += '\n';
  });
  return out;
}

}  // namespace

ReadResult read_obj(const MeshSource& source) { return ObjReader(source).run(); }

std::string format_obj(const TriangleSoup& soup, const SoupExtras& extras) {
  return text_of_obj(soup, extras, "");
}

std::vector<BundledFile> obj_files(const TriangleSoup& soup, const SoupExtras& extras,
                                   const std::filesystem::path& path) {
  std::vector<BundledFile> files;
  if (extras.attributes != nullptr) files = material_files(path, extras.folder, *extras.attributes);
  const std::string library = files.empty() ? "" : files.back().path.filename().string();
  files.push_back({path, text_of_obj(soup, extras, library)});
  return files;
}

}  // namespace meshrepair
