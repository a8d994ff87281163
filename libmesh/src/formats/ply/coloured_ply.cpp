// SPDX-License-Identifier: MIT
#include <bit>

#include <base/assert.h>
#include <mesh/coloured_ply.h>

namespace meshrepair {

std::string format_coloured_ply(const TriangleSoup& soup, std::span<const Colour> colours,
                                const std::vector<std::string>& comments) {
  static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");
  MESHREPAIR_ASSERT(colours.size() == soup.triangles.size());
  std::string out = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : comments) out += "comment " + comment + "\n";
  out += "element vertex " + std::to_string(soup.points.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(soup.triangles.size()) +
         "\nproperty list uchar uint vertex_indices\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
  out.reserve(out.size() + 24 * soup.points.size() + 16 * soup.triangles.size());
  for (const Vec3d& point : soup.points) {
    out.append(reinterpret_cast<const char*>(point.data()), 3 * sizeof(double));
  }
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    out += '\3';
    out.append(reinterpret_cast<const char*>(soup.triangles[t].data()), sizeof soup.triangles[t]);
    out.append(reinterpret_cast<const char*>(colours[t].data()), colours[t].size());
  }
  return out;
}

}  // namespace meshrepair
