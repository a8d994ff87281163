// SPDX-License-Identifier: MIT
#include "pictures/explanation_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <string_view>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/atomic_file.h>
#include <base/error.h>
#include <mesh/append_soup.h>
#include <mesh/coloured_ply.h>
#include <mesh/soup_io.h>
#include <repair/explain_repair.h>

#include "options/file_kinds.h"
#include "pictures/picture_steps.h"
#include "program/command_files.h"
#include "report/words.h"

namespace meshrepair {
namespace {

constexpr double kGap = 0.15;  // between the two, as a share of their width

// What a triangle can be, with the colour that says so.
struct Painted {
  std::string_view colour_name;
  std::string_view meaning;
  Colour colour;
};

// In the order of TriangleFate.
constexpr std::array<Painted, kTriangleFates> kFates = {{
    {"brown", "part of a solid or void that was removed", {140, 90, 50}},
    {"green", "thickened into a wall", {40, 170, 70}},
    {"blue", "flipped", {40, 90, 230}},
    {"grey", "whole in the result", {200, 200, 200}},
    {"yellow", "cut, moved, or merged with others", {245, 225, 40}},
    {"cyan", "sewn to others", {50, 200, 210}},
    {"violet", "inside the solid", {150, 90, 200}},
    {"magenta", "covered by others", {210, 40, 200}},
    {"black", "degenerate or too small", {0, 0, 0}},
    {"red", "bounds no solid", {220, 30, 30}},
}};

// In the order of TriangleOrigin.
constexpr std::array<Painted, kTriangleOrigins> kOrigins = {{
    {"grey", "whole triangles of IN", {200, 200, 200}},
    {"yellow", "pieces of triangles of IN", {245, 225, 40}},
    {"green", "walls of thickened sheets, cavities, drains and offsets", {40, 170, 70}},
    {"orange", "patches of holes and gaps", {245, 140, 20}},
    {"sky", "patches of sealed openings", {110, 190, 255}},
}};

// What one of both meshes is painted with.
struct Palette {
  std::string_view mesh;
  std::span<const Painted> kinds;
  std::vector<std::string_view> names;     // of the kinds
  std::vector<std::uint32_t> of_triangle;  // the same

  [[nodiscard]] std::vector<std::size_t> counts() const {
    std::vector<std::size_t> counts(kinds.size(), 0);
    for (const std::uint32_t kind : of_triangle) ++counts[kind];
    return counts;
  }
};

template <class Kind>
Palette palette_of(std::string_view mesh, std::span<const Painted> kinds,
                   std::string_view (*name_of)(Kind), const std::vector<Kind>& of_triangle) {
  Palette palette{mesh, kinds, {}, {}};
  palette.names.reserve(kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    palette.names.push_back(name_of(static_cast<Kind>(i)));
  }
  palette.of_triangle.reserve(of_triangle.size());
  for (const Kind kind : of_triangle) {
    palette.of_triangle.push_back(static_cast<std::uint32_t>(kind));
  }
  return palette;
}

std::array<Palette, 2> palettes_of(const RepairExplanation& explanation) {
  return {palette_of("input", kFates, fate_name, explanation.fates),
          palette_of("result", kOrigins, origin_name, explanation.origins)};
}

// A soup, and of each of its triangles which material it has.
struct PaintedMesh {
  TriangleSoup soup;
  Attributes attributes;
};

void drop_not_finite(TriangleSoup& soup, std::vector<std::uint32_t>& of_triangle) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& c = soup.triangles[t];
    const bool is_finite = std::all_of(c.begin(), c.end(),
                                       [&](std::uint32_t p) { return soup.points[p].allFinite(); });
    if (!is_finite) continue;
    soup.triangles[kept] = c;
    of_triangle[kept++] = of_triangle[t];
  }
  soup.triangles.resize(kept);
  of_triangle.resize(kept);
  for (Vec3d& point : soup.points) {
    if (!point.allFinite()) point = Vec3d::Zero();  // of no triangle
  }
}

PaintedMesh painted(const ExplainedMesh& mesh, const Palette& palette) {
  PaintedMesh all{mesh.soup, {}};
  TriangleLabels& materials = all.attributes.materials;
  materials.of_triangle = palette.of_triangle;
  for (std::size_t k = 0; k < palette.kinds.size(); ++k) {
    materials.names.push_back(fmt::format("{}: {}", palette.mesh, palette.names[k]));
    Material& look = all.attributes.looks.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) look.colour[i] = palette.kinds[k].colour[i] / 255.0;
    look.two_sided = true;
  }
  place_instances(all.soup, all.attributes, mesh.scene);
  drop_not_finite(all.soup, materials.of_triangle);
  return all;
}

// From the left side of one to that of the other, so that they stand beside each other.
Placement beside(const TriangleSoup& left, const TriangleSoup& right) {
  const auto sides = [](const TriangleSoup& soup) {
    std::array<double, 2> low_high = {0, 0};
    if (soup.triangles.empty()) return low_high;
    low_high.fill(soup.points[soup.triangles[0][0]].x());
    for (const auto& corners : soup.triangles) {
      for (const std::uint32_t p : corners) {
        low_high[0] = std::min(low_high[0], soup.points[p].x());
        low_high[1] = std::max(low_high[1], soup.points[p].x());
      }
    }
    return low_high;
  };
  const auto [left_low, left_high] = sides(left);
  const auto [right_low, right_high] = sides(right);
  const double gap = kGap * std::max(left_high - left_low, right_high - right_low);
  Placement placement;
  placement.offset.x() = left_high - right_low + gap;
  return placement;
}

std::vector<std::string> legend_of(const Palette& palette) {
  const std::vector<std::size_t> counts = palette.counts();
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const Painted& kind = palette.kinds[i];
    lines.push_back(fmt::format("{}: {} {}: {}, {}", palette.mesh, counts[i], palette.names[i],
                                kind.colour_name, kind.meaning));
  }
  return lines;
}

std::string ply_of(const std::array<PaintedMesh, 2>& meshes, const Placement& placement,
                   const std::array<Palette, 2>& palettes) {
  TriangleSoup all;
  std::vector<Colour> colours;
  std::vector<std::string> comments;
  for (std::size_t m = 0; m < 2; ++m) {
    append_soup(all, meshes[m].soup, m == 0 ? Placement() : placement);
    for (const std::uint32_t kind : meshes[m].attributes.materials.of_triangle) {
      colours.push_back(palettes[m].kinds[kind].colour);
    }
    for (std::string& line : legend_of(palettes[m])) comments.push_back(std::move(line));
  }
  comments.push_back(fmt::format("the result begins at face {}, and is moved along x by {}",
                                 meshes[0].soup.triangles.size(), placement.offset.x()));
  return format_coloured_ply(all, colours, comments);
}

void write_glb(const std::string& path, std::array<PaintedMesh, 2> meshes,
               const Placement& placement, ProgressObserver* progress) {
  Scene scene;
  TriangleSoup all;
  Attributes attributes;
  for (std::size_t m = 0; m < 2; ++m) {
    TriangleSoup& soup = meshes[m].soup;
    const std::string name = m == 0 ? "input" : "result";
    scene.meshes.push_back({name, soup.points.size(), soup.triangles.size()});
    scene.instances.push_back(
        {static_cast<std::uint32_t>(m), name, m == 0 ? Placement() : placement});
    append_attributes(attributes, all.triangles.size(), std::move(meshes[m].attributes),
                      soup.triangles.size());
    append_soup(all, soup);
  }
  WriteOptions options;
  options.format = SoupFormat::glb;
  options.extras.attributes = &attributes;
  options.extras.scene = &scene;
  options.progress = progress;
  write_soup(all, path, options);
}

Json counts_of(const Palette& palette) {
  const std::vector<std::size_t> counts = palette.counts();
  Json json = Json::object();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    json[std::string(palette.names[i])] = counts[i];
  }
  return json;
}

std::string help_of(std::span<const Painted> kinds) {
  std::string text;
  for (const Painted& kind : kinds) {
    text += fmt::format("\n  {:<8} {}", kind.colour_name, kind.meaning);
  }
  return text;
}

template <class Kind>
std::vector<TriangleKind> kinds_of(std::span<const Painted> painted,
                                   std::string_view (*name_of)(Kind)) {
  std::vector<TriangleKind> kinds;
  for (std::size_t i = 0; i < painted.size(); ++i) {
    kinds.push_back({name_of(static_cast<Kind>(i)), painted[i].meaning, painted[i].colour});
  }
  return kinds;
}

}  // namespace

std::vector<TriangleKind> kinds_of_fates() { return kinds_of<TriangleFate>(kFates, fate_name); }

std::vector<TriangleKind> kinds_of_origins() {
  return kinds_of<TriangleOrigin>(kOrigins, origin_name);
}

void add_explain_option(CommandLine& app, std::string& path) {
  app.add_option(
         "--explain", path,
         "Write IN and OUT side by side as PLY or GLB, each triangle of IN coloured by its\n"
         "fate:" +
             help_of(kFates) + "\nand each triangle of OUT by its origin:" + help_of(kOrigins))
      ->check(names_side_file(".ply, .glb"))
      ->type_name("FILE")
      ->group("Output");
}

void check_explanation(const std::string& path, const std::vector<std::string>& files, Run& run) {
  if (path.empty()) return;
  if (lower_extension(path) != ".ply" && lower_extension(path) != ".glb") {
    throw UsageError("--explain: " + path + " ends neither in .ply nor in .glb");
  }
  check_side_file({"--explain", path, "explanation"}, files, run);
}

void write_explanation_stage(const std::string& path, const ExplainedMesh& input,
                             const ExplainedMesh& result, Run& run, Findings& findings) {
  if (path.empty()) return;
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("explain");
  const std::array<Palette, 2> palettes = palettes_of(findings.repair.explanation);
  std::array<PaintedMesh, 2> meshes = {painted(input, palettes[0]), painted(result, palettes[1])};
  const Placement placement = beside(meshes[0].soup, meshes[1].soup);
  if (lower_extension(path) == ".ply") {
    write_file_atomically(path, ply_of(meshes, placement, palettes), &run.progress);
  } else {
    write_glb(path, std::move(meshes), placement, &run.progress);
  }
  findings.explained = path;
  run.report.set_section(
      "explain",
      {{"path", path}, {"input", counts_of(palettes[0])}, {"result", counts_of(palettes[1])}});
}

std::array<Attributes, 2> painted_fates(const PictureRequest& request, const Findings& findings) {
  std::array<Attributes, 2> both;
  if (!request.painted) return both;
  const std::array<Palette, 2> palettes = palettes_of(findings.repair.explanation);
  for (std::size_t i = 0; i < both.size(); ++i) {
    std::vector<Colour> colours;
    colours.reserve(palettes[i].of_triangle.size());
    for (const std::uint32_t kind : palettes[i].of_triangle) {
      colours.push_back(palettes[i].kinds[kind].colour);
    }
    both[i] = painted(colours);
  }
  return both;
}

std::vector<std::string> explanation_lines(const Findings& findings) {
  if (findings.explained.empty()) return {};
  std::vector<std::string> lines = {findings.explained};
  for (const Palette& palette : palettes_of(findings.repair.explanation)) {
    const std::vector<std::size_t> counts = palette.counts();
    std::vector<std::string> words;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] == 0) continue;
      words.push_back(fmt::format("{} {} ({})", grouped(counts[i]), palette.kinds[i].meaning,
                                  palette.kinds[i].colour_name));
    }
    lines.push_back(fmt::format("{}: {}", palette.mesh, fmt::join(words, ", ")));
  }
  return lines;
}

}  // namespace meshrepair
