// SPDX-License-Identifier: MIT
#include "describe/build_facts.h"

#include <boost/version.hpp>
#include <expat.h>
#include <meshoptimizer.h>
#include <png.h>
#include <sstream>
#include <string_view>
#include <zip.h>
#include <zlib.h>
#include <zstd.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <OpenMesh/Core/System/config.h>
#include <nlohmann/json_fwd.hpp>
#include <spdlog/fmt/fmt.h>
#include <spdlog/version.h>

#include <base/warning.h>
#include <mesh/mesh_limits.h>
#include <mesh/point_io.h>
#include <mesh/soup_format.h>

#include "options/file_kinds.h"
#include "options/numbers.h"
#include "report/json_report.h"

namespace meshrepair {
namespace {

std::string dotted(int major, int minor, int patch) {
  return fmt::format("{}.{}.{}", major, minor, patch);
}

// Those whose headers say their version; the build says that of the others.
Json libraries() {
  Json list = {
      {"Boost", dotted(BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
      {"CLI11", CLI11_VERSION},
      {"draco", MESHREPAIR_DRACO_VERSION},
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"expat", dotted(XML_MAJOR_VERSION, XML_MINOR_VERSION, XML_MICRO_VERSION)},
      {"libjpeg", MESHREPAIR_JPEG_VERSION},
      {"libpng", PNG_LIBPNG_VER_STRING},
      {"libzip", LIBZIP_VERSION},
      {"meshoptimizer",
       fmt::format("{}.{}", MESHOPTIMIZER_VERSION / 1000, MESHOPTIMIZER_VERSION / 10 % 100)},
      {"nanoflann", MESHREPAIR_NANOFLANN_VERSION},
      {"nlohmann_json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                               NLOHMANN_JSON_VERSION_PATCH)},
      {"OpenMesh", dotted(OM_GET_VER, OM_GET_MAJ, OM_GET_MIN)},
      {"spdlog", dotted(SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH)},
      {"zlib", ZLIB_VERSION},
      {"zstd", ZSTD_VERSION_STRING}};
  constexpr std::string_view kTbb = MESHREPAIR_TBB_VERSION;
  if (!kTbb.empty()) list["oneTBB"] = kTbb;
  return list;
}

std::string compiler() {
#ifdef __clang__
  return std::string("Clang ") + __clang_version__;
#elif defined(__GNUC__)
  return std::string("GCC ") + __VERSION__;
#else
  return "unknown";
#endif
}

// ".stl, .obj" as a list.
Json list_of(std::string_view extensions) {
  Json list = Json::array();
  std::istringstream stream{std::string(extensions)};
  for (std::string one; stream >> one;) {
    if (one.ends_with(',')) one.pop_back();
    list.push_back(one);
  }
  return list;
}

Json warnings() {
  Json list = Json::array();
  for (const WarningKind& kind : warning_kinds()) {
    list.push_back(
        {{"code", kind.code}, {"changes_object", kind.changes_object}, {"meaning", kind.meaning}});
  }
  return list;
}

}  // namespace

Json build_facts(const std::string& program) {
  constexpr bool kHasThreads = !std::string_view(MESHREPAIR_TBB_VERSION).empty();
  return {{"program", program},
          {"version", program_version()},
          {"report_version", kReportVersion},
          {"build",
           {{"compiler", compiler()},
            {"type", MESHREPAIR_BUILD_TYPE},
            {"system", MESHREPAIR_BUILD_SYSTEM},
            {"threads", kHasThreads}}},
          {"libraries", libraries()},
          {"formats",
           {{"meshes", list_of(known_extensions())},
            {"points", list_of(known_point_extensions())},
            {"packed", list_of(kPackedExtensions)}}},
          {"limits",
           {{"points", kMostPoints}, {"triangles", kMostTriangles}, {"threads", kMostThreads}}},
          {"warnings", warnings()}};
}

}  // namespace meshrepair
