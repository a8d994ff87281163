// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cctype>
#include <initializer_list>
#include <map>
#include <utility>

#include <mesh/edge_table.h>
#include <mesh/region_mesh.h>

#include "formats/common/text_writer.h"

namespace meshrepair {
namespace {

constexpr std::array<std::pair<RegionFormat, std::string_view>, 5> kRegionFormats = {{
    {RegionFormat::ply, "PLY"},
    {RegionFormat::obj, "OBJ"},
    {RegionFormat::vtp, "VTP"},
    {RegionFormat::poly, "POLY"},
    {RegionFormat::msh, "MSH"},
}};

// Two regions, or parts of them, the lower first, and the triangles between them.
struct Interface {
  std::uint32_t a = 0, b = 0;
  std::vector<std::uint32_t> triangles;  // ascending
};

// sides_of(t): what is on the sides of a triangle.
template <class SidesOf>
std::vector<Interface> interfaces_by(std::size_t triangles, const SidesOf& sides_of) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> by_pair;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const std::array<std::uint32_t, 2> sides = sides_of(t);
    by_pair[std::minmax(sides[0], sides[1])].push_back(t);
  }
  std::vector<Interface> all;
  all.reserve(by_pair.size());
  for (auto& [pair, list] : by_pair) all.push_back({pair.first, pair.second, std::move(list)});
  return all;
}

std::vector<Interface> interfaces_of_regions(const RegionMesh& regions) {
  return interfaces_by(regions.parts_of.size(),
                       [&](std::size_t t) { return regions.regions_of(t); });
}

std::vector<Interface> interfaces_of_parts(const RegionMesh& regions) {
  return interfaces_by(regions.parts_of.size(), [&](std::size_t t) { return regions.parts_of[t]; });
}

// With an underscore for each character that would end it.
std::string plain(std::string name) {
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte <= ' ' || byte == 0x7f || c == '"') c = '_';
  }
  return name;
}

const std::string& name_of(const RegionMesh& regions, std::uint32_t region) {
  return regions.names[region - 1];
}

std::string as_ply(const RegionMesh& regions, std::span<const std::string> comments) {
  static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");
  const TriangleSoup& mesh = regions.mesh;
  std::string out = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : comments) out += "comment " + comment + "\n";
  for (std::uint32_t r = 1; r <= regions.names.size(); ++r) {
    out += "comment region " + std::to_string(r) + " " + plain(name_of(regions, r)) + "\n";
  }
  out += "element vertex " + std::to_string(mesh.points.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(mesh.triangles.size()) +
         "\nproperty list uchar uint vertex_indices\nproperty uint front\nproperty uint behind\n"
         "end_header\n";
  for (const Vec3d& p : mesh.points) {
    out.append(reinterpret_cast<const char*>(p.data()), 3 * sizeof(double));
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    out += '\3';
    out.append(reinterpret_cast<const char*>(mesh.triangles[t].data()), sizeof mesh.triangles[t]);
    const std::array<std::uint32_t, 2> sides = regions.regions_of(t);
    out.append(reinterpret_cast<const char*>(sides.data()), sizeof sides);
  }
  return out;
}

std::string as_obj(const RegionMesh& regions, std::span<const std::string> comments) {
  std::string out;
  for (const std::string& comment : comments) out += "# " + comment + "\n";
  append_lines(out, regions.mesh.points.size(), [&](std::string& lines, std::size_t p) {
    lines += "v ";
    append_triple(lines, regions.mesh.points[p]);
    lines += '\n';
  });
  for (const Interface& one : interfaces_of_regions(regions)) {
    out += "g";
    for (const std::uint32_t r : {one.a, one.b}) {
      if (r != 0) out += " " + plain(name_of(regions, r));
    }
    out += '\n';
    append_lines(out, one.triangles.size(), [&](std::string& lines, std::size_t i) {
      const auto& [a, b, c] = regions.mesh.triangles[one.triangles[i]];
      lines += "f ";
      append_triple(lines, std::array{a + 1, b + 1, c + 1});
      lines += '\n';
    });
  }
  return out;
}

std::string as_vtp(const RegionMesh& regions, std::span<const std::string> comments) {
  const TriangleSoup& mesh = regions.mesh;
  std::string out = "<?xml version=\"1.0\"?>\n";
  const auto array = [&](const char* type, const std::string& name, const char* components,
                         std::size_t count, const auto& append) {
    out += std::string("<DataArray type=\"") + type + "\" Name=\"" + name +
           "\" NumberOfComponents=\"" + components + "\" format=\"ascii\">\n";
    append_lines(out, count, [&](std::string& lines, std::size_t i) {
      append(lines, i);
      lines += '\n';
    });
    out += "</DataArray>\n";
  };
  const auto side = [&](std::size_t k) {
    return [&, k](std::string& lines, std::size_t t) {
      append_number(lines, regions.regions_of(t)[k]);
    };
  };
  for (std::string comment : comments) {
    std::replace(comment.begin(), comment.end(), '-', '_');  // two of them end a comment
    out += "<!-- " + comment + " -->\n";
  }
  out +=
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n"
      "<Piece NumberOfPoints=\"" +
      std::to_string(mesh.points.size()) + "\" NumberOfPolys=\"" +
      std::to_string(mesh.triangles.size()) + "\">\n<Points>\n";
  array("Float64", "Points", "3", mesh.points.size(),
        [&](std::string& lines, std::size_t p) { append_triple(lines, mesh.points[p]); });
  out += "</Points>\n<Polys>\n";
  array("Int64", "connectivity", "1", mesh.triangles.size(),
        [&](std::string& lines, std::size_t t) { append_triple(lines, mesh.triangles[t]); });
  array("Int64", "offsets", "1", mesh.triangles.size(),
        [&](std::string& lines, std::size_t t) { append_number(lines, 3 * (t + 1)); });
  out += "</Polys>\n<CellData>\n";
  array("UInt32", "front", "1", mesh.triangles.size(), side(0));
  array("UInt32", "behind", "1", mesh.triangles.size(), side(1));
  out += "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  return out;
}

std::string as_poly(const RegionMesh& regions, std::span<const std::string> comments) {
  std::string out;
  for (const std::string& comment : comments) out += "# " + comment + "\n";
  const TriangleSoup& mesh = regions.mesh;
  out += std::to_string(mesh.points.size()) + " 3 0 0\n";
  append_lines(out, mesh.points.size(), [&](std::string& lines, std::size_t p) {
    append_number(lines, p);
    lines += ' ';
    append_triple(lines, mesh.points[p]);
    lines += '\n';
  });
  std::uint32_t marker = 0;
  out += std::to_string(mesh.triangles.size()) + " 1\n";
  for (const Interface& one : interfaces_of_regions(regions)) {
    out += "# marker " + std::to_string(++marker) + ":";
    for (const std::uint32_t r : {one.a, one.b}) {
      out += ' ' + (r == 0 ? std::string("outside") : plain(name_of(regions, r)));
    }
    out += '\n';
    append_lines(out, one.triangles.size(), [&](std::string& lines, std::size_t i) {
      lines += "1 0 ";
      append_number(lines, marker);
      lines += "\n3 ";
      append_triple(lines, mesh.triangles[one.triangles[i]]);
      lines += '\n';
    });
  }
  const auto voids = std::count_if(regions.seeds.begin(), regions.seeds.end(),
                                   [](const RegionSeed& seed) { return seed.region == 0; });
  // The holes, then the regions.
  for (const bool of_regions : {false, true}) {
    std::size_t number = 0;
    out += std::to_string(of_regions ? static_cast<std::ptrdiff_t>(regions.seeds.size()) - voids
                                     : voids) +
           "\n";
    for (const RegionSeed& seed : regions.seeds) {
      if ((seed.region != 0) != of_regions) continue;
      append_number(out, ++number);
      out += ' ';
      append_triple(out, seed.place);
      if (of_regions) out += ' ' + std::to_string(seed.region);
      out += '\n';
    }
  }
  return out;
}

// Of a file of Gmsh. Tags of surfaces count from 1, in the order of the interfaces between parts;
// those of physical groups, in the order of the pairs of regions.
class MshText {
 public:
  explicit MshText(const RegionMesh& regions)
      : regions_(regions), all_(interfaces_of_parts(regions)) {
    for (const Interface& one : all_) groups_.emplace(regions_of(one), 0);
    std::size_t tag = 0;
    for (auto& [pair, number] : groups_) number = ++tag;
  }

  std::string run(std::span<const std::string> comments) {
    out_ = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    if (!comments.empty()) {
      out_ += "$Comments\n";
      for (const std::string& comment : comments) out_ += comment + "\n";
      out_ += "$EndComments\n";
    }
    add_names();
    add_entities();
    add_nodes();
    add_elements();
    return std::move(out_);
  }

 private:
  // The lower one first.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> regions_of(const Interface& one) const {
    return std::minmax({regions_.region_of_part[one.a], regions_.region_of_part[one.b]});
  }

  void add_names() {
    out_ += "$PhysicalNames\n" + std::to_string(groups_.size()) + "\n";
    for (const auto& [pair, tag] : groups_) {
      out_ += "2 " + std::to_string(tag) + " \"" +
              (pair.first == 0 ? std::string() : plain(name_of(regions_, pair.first)) + "|") +
              plain(name_of(regions_, pair.second)) + "\"\n";
    }
    out_ += "$EndPhysicalNames\n";
  }

  void add_entities() {
    out_ += "$Entities\n0 0 " + std::to_string(all_.size()) + " 0\n";
    for (std::size_t i = 0; i < all_.size(); ++i) {
      out_ += std::to_string(i + 1) + " ";
      add_box(all_[i]);
      out_ += " 1 " + std::to_string(groups_.at(regions_of(all_[i]))) + " 0\n";
    }
    out_ += "$EndEntities\n";
  }

  void add_box(const Interface& interface) {
    const auto& mesh = regions_.mesh;
    Vec3d low = mesh.points[mesh.triangles[interface.triangles[0]][0]], high = low;
    for (const std::uint32_t t : interface.triangles) {
      for (const std::uint32_t p : mesh.triangles[t]) {
        low = low.cwiseMin(mesh.points[p]);
        high = high.cwiseMax(mesh.points[p]);
      }
    }
    append_triple(out_, low);
    out_ += ' ';
    append_triple(out_, high);
  }

  // Each with the first interface that has it.
  void add_nodes() {
    const auto& mesh = regions_.mesh;
    std::vector<char> is_known(mesh.points.size(), 0);
    const std::string count = std::to_string(mesh.points.size());
    out_ += "$Nodes\n" + std::to_string(all_.size()) + " " + count + " 1 " + count + "\n";
    for (std::size_t i = 0; i < all_.size(); ++i) {
      std::vector<std::uint32_t> nodes;
      for (const std::uint32_t t : all_[i].triangles) {
        for (const std::uint32_t p : mesh.triangles[t]) {
          if (std::exchange(is_known[p], 1) == 0) nodes.push_back(p);
        }
      }
      out_ += "2 " + std::to_string(i + 1) + " 0 " + std::to_string(nodes.size()) + "\n";
      for (const std::uint32_t p : nodes) out_ += std::to_string(p + 1) + "\n";
      append_lines(out_, nodes.size(), [&](std::string& lines, std::size_t n) {
        append_triple(lines, mesh.points[nodes[n]]);
        lines += '\n';
      });
    }
    out_ += "$EndNodes\n";
  }

  void add_elements() {
    const auto& mesh = regions_.mesh;
    const std::string count = std::to_string(mesh.triangles.size());
    out_ += "$Elements\n" + std::to_string(all_.size()) + " " + count + " 1 " + count + "\n";
    std::size_t before = 0;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const std::vector<std::uint32_t>& triangles = all_[i].triangles;
      out_ += "2 " + std::to_string(i + 1) + " 2 " + std::to_string(triangles.size()) + "\n";
      append_lines(out_, triangles.size(), [&](std::string& lines, std::size_t k) {
        const auto& [a, b, c] = mesh.triangles[triangles[k]];
        append_number(lines, before + k + 1);
        lines += ' ';
        append_triple(lines, std::array{a + 1, b + 1, c + 1});
        lines += '\n';
      });
      before += triangles.size();
    }
    out_ += "$EndElements\n";
  }

  const RegionMesh& regions_;
  std::vector<Interface> all_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> groups_;  // tags, by regions
  std::string out_;
};

}  // namespace

std::string format_gmsh_script(const RegionMesh& regions, std::string_view msh) {
  std::vector<std::string> around(regions.region_of_part.size());  // of each part its surfaces
  std::size_t surface = 0;
  for (const Interface& one : interfaces_of_parts(regions)) {
    ++surface;
    for (const std::uint32_t part : {one.a, one.b}) {
      around[part] += (around[part].empty() ? "" : ", ") + std::to_string(surface);
    }
  }
  std::string out;
  const auto add = [&](std::initializer_list<std::string_view> words) {
    for (const std::string_view word : words) out += word;
  };
  add({"Merge \"", msh, "\";\n"});
  std::vector<std::string> volumes(regions.names.size() + 1);
  for (std::size_t part = 1; part < around.size(); ++part) {
    const std::uint32_t region = regions.region_of_part[part];
    if (region == 0) continue;
    const std::string tag = std::to_string(part);
    add({"Surface Loop(", tag, ") = {", around[part], "};\nVolume(", tag, ") = {", tag, "};\n"});
    volumes[region] += (volumes[region].empty() ? "" : ", ") + tag;
  }
  for (std::uint32_t r = 1; r < volumes.size(); ++r) {
    if (volumes[r].empty()) continue;
    add({"Physical Volume(\"", plain(name_of(regions, r)), "\", ", std::to_string(r), ") = {",
         volumes[r], "};\n"});
  }
  return out;
}

std::optional<RegionFormat> region_format_of(std::string_view path) {
  const std::size_t dot = path.find_last_of("./\\");
  if (dot == std::string_view::npos || path[dot] != '.') return std::nullopt;
  std::string extension(path.substr(dot + 1));
  for (char& c : extension) {
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  for (const auto& [format, name] : kRegionFormats) {
    if (extension == name) return format;
  }
  return std::nullopt;
}

std::string_view region_format_name(RegionFormat format) {
  return kRegionFormats.at(static_cast<std::size_t>(format)).second;
}

std::string format_region_mesh(const RegionMesh& regions, RegionFormat format,
                               std::span<const std::string> comments) {
  switch (format) {
    case RegionFormat::ply:
      return as_ply(regions, comments);
    case RegionFormat::obj:
      return as_obj(regions, comments);
    case RegionFormat::vtp:
      return as_vtp(regions, comments);
    case RegionFormat::poly:
      return as_poly(regions, comments);
    case RegionFormat::msh:
      break;
  }
  return MshText(regions).run(comments);
}

}  // namespace meshrepair
