// SPDX-License-Identifier: MIT
// How well are solids found again from samples of their surface? Markdown, one row for each cloud.
//
//   points_table [--sizes 2000,20000] [--only SOLID] [--clouds FOLDER] [--votes N] [--agree 0|1]
//                [--reach X] [--neighbours N] [--project N] [--inside RULE]
#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include <base/error.h>
#include <check/mesh_distance.h>
#include <mesh/soup_io.h>
#include <points/point_soup.h>
#include <repair/keep_parts.h>
#include <repair/repair.h>

#include "bench_cases.h"
#include "point_clouds.h"
#include "shapes.h"

namespace meshrepair::bench {
namespace {

using namespace meshrepair::testing;

constexpr std::uint64_t kSeed = 20261122;

struct Settings {
  std::vector<std::size_t> sizes = {2000, 20000, 200000};
  std::string only;
  std::string folder;  // for the clouds as XYZ files and the solids; empty: they are not kept
  PointSoupOptions soup;
  RepairOptions repair;
};

struct Solid {
  std::string name;
  TriangleSoup surface;
  std::int64_t genus = 0;
  std::size_t parts = 1;
};

// A plate of side 1 whose thickness is so many spacings of the cloud.
TriangleSoup plate(double spacings, std::size_t points, double& spacing) {
  double thickness = 0;
  for (int round = 0; round < 50; ++round) {
    spacing = std::sqrt((2 + 4 * thickness) / static_cast<double>(points));
    thickness = spacings * spacing;
  }
  return box({0, 0, 0}, {1, 1, thickness});
}

std::vector<Solid> solids_of(std::size_t points) {
  double spacing = 0;
  const TriangleSoup thin = plate(3, points, spacing);
  const TriangleSoup one = plate(3, points / 2, spacing);
  TriangleSoup two = one;
  append(two, moved(one, {0, 0, 7 * spacing}));
  return {{"sphere", sphere(100000), 0, 1},
          {"torus", torus(600, 200), 1, 1},
          {"plate, 3 thick", thin, 0, 1},
          {"two plates, 4 apart", two, 0, 2},
          {"genus 5", genus_five_body(), 5, 1}};
}

struct Cloud {
  std::string name;
  PointCloud cloud;
};

std::vector<Cloud> clouds_of(const TriangleSoup& surface, std::size_t points) {
  const double spacing = spacing_of(surface, points);
  std::vector<Cloud> clouds;
  clouds.push_back({"even", sampled_evenly(surface, points, kSeed)});
  clouds.push_back({"even, noise 0.1", with_noise(clouds[0].cloud, 0.1 * spacing, kSeed)});
  clouds.push_back({"random", sampled_at_random(surface, points, kSeed)});
  clouds.push_back({"random, noise 0.1", with_noise(clouds[2].cloud, 0.1 * spacing, kSeed)});
  return clouds;
}

// The Hausdorff distance, each way, in spacings.
std::string distance_text(const TriangleSoup& result, const Solid& solid, std::size_t points) {
  const double spacing = spacing_of(solid.surface, points);
  const MeshDistance distance = mesh_distance(result, solid.surface);
  char text[64];
  std::snprintf(text, sizeof text, "%.2f / %.2f", distance.forth.largest / spacing,
                distance.back.largest / spacing);
  return text;
}

// With underscores for what is not a letter or a digit.
std::string file_name(std::string name) {
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

// SOLID_CLOUD_POINTS.xyz
void keep_cloud(const Solid& solid, const Cloud& cloud, const std::string& folder) {
  const std::string name =
      file_name(solid.name + "_" + cloud.name + "_" + std::to_string(cloud.cloud.points.size()));
  std::ofstream file(folder + "/" + name + ".xyz");
  file.precision(17);
  for (const Vec3d& p : cloud.cloud.points) {
    file << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  }
}

void print_row(const Solid& solid, const Cloud& cloud, const Settings& settings,
               std::size_t points) {
  PointSoupReport soup_report;
  RepairReport report;
  PointSoup soup;
  std::string verdict = "certified";
  std::string distance = "-";
  std::int64_t genus = -1;
  double repair_seconds = 0;
  const Measurement local =
      measure([&] { soup = make_point_soup(cloud.cloud, settings.soup, soup_report); });
  try {
    Surface surface;
    RepairOptions options = settings.repair;
    options.opacity = soup.opacity();
    repair_seconds = measure([&] {
                       surface = repair(soup.soup, options, report);
                       drop_small_parts(surface, settings.soup.fewest_triangles, report);
                     }).cpu_seconds;
    const Topology& output = report.output;
    if (!report.certify.passed() || !output.closed() || !output.manifold() || !output.oriented()) {
      verdict = "FAILS";
    }
    genus = genus_of(output, surface.mesh.points.size());
    if (genus != solid.genus || output.parts != solid.parts) verdict += ", WRONG";
    distance = distance_text(surface.mesh, solid, points);
  } catch (const Error& error) {
    verdict = error.what();
  }
  std::printf(
      "| %s | %s | %zu | %zu / %zu / %zu | %zu | %zu | %zu, %zu | %.3g | %s | %lld | %zu | %s | %s "
      "| %.2f | %.2f |\n",
      solid.name.c_str(), cloud.name.c_str(), cloud.cloud.points.size(), soup_report.by_votes[2],
      soup_report.by_votes[1], soup_report.by_votes[0], report.input.open_edges,
      report.input.nonmanifold_edges, report.holes.closed, report.holes.too_large,
      100 * report.holes.area / std::max(report.input_area, 1e-300),
      std::string(rule_name(report.inside.used)).c_str(), static_cast<long long>(genus),
      report.output.parts, distance.c_str(), verdict.c_str(), local.cpu_seconds, repair_seconds);
  std::fflush(stdout);
}

Settings settings_of(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string name = argv[i];
    const std::string value = argv[i + 1];
    if (name == "--sizes") {
      settings.sizes.clear();
      for (std::size_t at = 0; at < value.size(); at = value.find(',', at) + 1) {
        settings.sizes.push_back(std::stoul(value.substr(at)));
        if (value.find(',', at) == std::string::npos) break;
      }
    } else if (name == "--only") {
      settings.only = value;
    } else if (name == "--clouds") {
      settings.folder = value;
    } else if (name == "--votes") {
      settings.soup.votes = std::stoi(value);
    } else if (name == "--agree") {
      settings.soup.agree = value == "1";
    } else if (name == "--reach") {
      settings.soup.reach = std::stod(value);
    } else if (name == "--neighbours") {
      settings.soup.neighbours = std::stoul(value);
    } else if (name == "--project") {
      settings.soup.project = std::stoi(value);
    } else if (name == "--inside") {
      for (const InsideRule rule :
           {InsideRule::solidity, InsideRule::parity, InsideRule::winding}) {
        if (rule_name(rule) == value) settings.repair.inside.rule = rule;
      }
    } else {
      throw UsageError("unknown option " + name);
    }
  }
  return settings;
}

void run(const Settings& settings) {
  std::printf(
      "| solid | cloud | points | triangles by 3 / 2 / 1 votes | open edges | edges of more than 2 "
      "| holes closed, left | their area, %% | rule | genus | parts | distance to / from the "
      "truth, spacings | "
      "result | triangulation, s | repair, s "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::size_t points : settings.sizes) {
    for (const Solid& solid : solids_of(points)) {
      if (solid.name.find(settings.only) == std::string::npos) continue;
      if (!settings.folder.empty()) {
        write_soup(solid.surface, settings.folder + "/" + file_name(solid.name) + ".off", {});
      }
      for (const Cloud& cloud : clouds_of(solid.surface, points)) {
        if (!settings.folder.empty()) keep_cloud(solid, cloud, settings.folder);
        print_row(solid, cloud, settings, points);
      }
    }
  }
}

}  // namespace
}  // namespace meshrepair::bench

int main(int argc, char** argv) {
  try {
    meshrepair::bench::run(meshrepair::bench::settings_of(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "points_table: %s\n", error.what());
    return 2;
  }
  return 0;
}
