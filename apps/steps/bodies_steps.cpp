// SPDX-License-Identifier: MIT
#include "steps/bodies_steps.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

#include <spdlog/logger.h>

#include <base/error.h>
#include <mesh/append_soup.h>

#include "options/choice_option.h"
#include "options/repair_options.h"
#include "report/words.h"
#include "steps/run_steps.h"
#include "summary/summary.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

// Of regions in the summary.
constexpr std::size_t kMostRegionLines = 20;

constexpr std::array<Choice<BodiesBy>, 3> kBy = {
    {{"object", BodiesBy::object}, {"group", BodiesBy::group}, {"material", BodiesBy::material}}};

const TriangleLabels& labels_of(const Attributes& attributes, BodiesBy by) {
  switch (by) {
    case BodiesBy::group:
      return attributes.groups;
    case BodiesBy::material:
      return attributes.materials;
    default:
      return attributes.objects;
  }
}

// How many names triangles have.
std::size_t names_in(const TriangleLabels& labels) {
  std::vector<char> is_used(labels.names.size() + 1, 0);
  for (const std::uint32_t n : labels.of_triangle) {
    is_used[std::min<std::size_t>(n, labels.names.size())] = 1;
  }
  return static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), 1));
}

const TriangleLabels& chosen_labels(const Attributes& attributes, BodiesBy by) {
  for (const auto& [name, choice] : kBy) {
    if (by != BodiesBy::any && by != choice) continue;
    const TriangleLabels& labels = labels_of(attributes, choice);
    if (names_in(labels) > (by == BodiesBy::any ? 1 : 0)) return labels;
    if (by == choice) throw InputError("no " + std::string(name) + " has a name");
  }
  throw InputError("one body alone: it has no two objects, groups or materials");
}

// Gmsh reads no name of more than 255 bytes, and files have none.
constexpr std::size_t kLongestName = 120;

// As it is, or shorter, or with a number that makes it another one than those taken.
std::string new_name(std::string name, std::set<std::string>& taken) {
  if (name.size() > kLongestName) {
    std::size_t end = kLongestName;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;  // UTF-8
    name = name.substr(0, end) + "...";
  }
  std::string unique = name;
  for (int n = 2; !taken.insert(unique).second; ++n) unique = name + "-" + std::to_string(n);
  return unique;
}

// Of one region what it has faces in common with.
struct Neighbour {
  std::uint32_t region = 0;
  const BodyContact* contact = nullptr;
};

// Of each region, by their numbers; of the outside, too.
std::vector<std::vector<Neighbour>> neighbours_of(const ConformingBodies& result) {
  std::vector<std::vector<Neighbour>> neighbours(result.regions.size() + 1);
  for (const BodyContact& contact : result.contacts) {
    neighbours[contact.a].push_back({contact.b, &contact});
    neighbours[contact.b].push_back({contact.a, &contact});
  }
  return neighbours;
}

Json region_facts(const Bodies& bodies, const ConformingBodies& result, std::uint32_t number,
                  const std::vector<Neighbour>& neighbours) {
  const BodyRegion& region = result.regions[number - 1];
  Json list = Json::array();
  for (const auto& [other, contact] : neighbours) {
    list.push_back({{"region", other}, {"triangles", contact->triangles}, {"area", contact->area}});
  }
  return {{"region", number},        {"name", bodies.name_of(number)},
          {"bodies", region.bodies}, {"volume", region.volume},
          {"parts", region.parts},   {"triangles", region.triangles},
          {"neighbours", list}};
}

Json bodies_section(const Bodies& bodies, const ConformingBodies& result,
                    const BodiesCommand& command, const BodiesFacts& facts) {
  const BodiesReport& report = facts.report;
  Json regions = Json::array();
  double volume = 0;
  const auto neighbours = neighbours_of(result);
  for (std::uint32_t r = 1; r <= result.regions.size(); ++r) {
    Json region = region_facts(bodies, result, r, neighbours[r]);
    if (!facts.files.empty() && !facts.files[r - 1].empty()) region["file"] = facts.files[r - 1];
    regions.push_back(std::move(region));
    volume += result.regions[r - 1].volume;
  }
  return {{"regions", std::move(regions)},
          {"volume", volume},
          {"points", result.mesh.points.size()},
          {"triangles", result.mesh.triangles.size()},
          {"overlap", overlap_name(command.overlap)},
          {"overlaps", report.overlaps},
          {"overlap_volume", report.overlap_volume},
          {"cut_triangles", report.cut_triangles},
          {"pairs_at_first", report.pairs_at_first},
          {"moves", report.moves},
          {"moved_by", report.moved_by},
          {"pairs", report.pairs},
          {"turned_edges", report.turned_edges},
          {"turned_parts", report.turned_parts},
          {"certified", report.passed()}};
}

std::string region_line(const Bodies& bodies, const ConformingBodies& result, std::uint32_t number,
                        const std::vector<Neighbour>& neighbours) {
  const BodyRegion& region = result.regions[number - 1];
  std::string line =
      fmt::format("{:<9} {}: volume {:.6g}", "region", bodies.name_of(number), region.volume);
  if (region.triangles == 0) {
    const bool is_empty = bodies.is_empty(result, number);
    return line + (is_empty ? ", as the input is empty\n" : ", as others have all of it\n");
  }
  if (region.parts > 1) line += fmt::format(" in {}", number_of(region.parts, "part"));
  for (const auto& [other, contact] : neighbours) {
    if (other == 0) continue;
    line += fmt::format(", area {:.6g} in common with {}", contact->area, bodies.name_of(other));
  }
  return line + "\n";
}

}  // namespace

void add_bodies_command(CommandLine& app, BodiesCommand& command) {
  static constexpr std::array<Choice<Overlap>, 4> kOverlaps = {{{"first", Overlap::first},
                                                                {"last", Overlap::last},
                                                                {"smaller", Overlap::smaller},
                                                                {"own", Overlap::own}}};
  add_choice(
      app, "--overlap", kOverlaps, [&command](Overlap overlap) { command.overlap = overlap; },
      "To which body a place belongs that several are around:\n"
      "  first    to the first of them (default)\n"
      "  last     to the last\n"
      "  smaller  to the one with the least volume\n"
      "  own      to a region of its own");
  add_choice(
      app, "--by", kBy, [&command](BodiesBy by) { command.by = by; },
      "What tells the bodies of one file apart: object, group or material;\n"
      "by default the first of these that has several names");
  add_join_gaps_option(app, command.repair.join_gaps);
  add_inside_options(app, command.repair.inside);
  add_sew_option(app, command.repair.sew);
  add_holes_option(app, command.repair.holes);
  add_max_hole_option(app, command.repair.holes);
}

std::vector<NamedSoup> named_bodies(TriangleSoup soup, const Attributes& attributes, BodiesBy by,
                                    const std::string& rest) {
  Attributes named;
  named.objects = chosen_labels(attributes, by);
  const Scene scene = split_objects(soup, named);
  std::vector<NamedSoup> bodies;
  for (TriangleSoup& mesh : meshes_of(soup, scene)) {
    const std::string& name = scene.meshes[bodies.size()].name;
    bodies.push_back({name.empty() ? rest : name, std::move(mesh)});
  }
  return bodies;
}

void Bodies::add(NamedSoup body, const BodiesCommand& command, Run& run, const Findings& findings,
                 Json& facts) {
  std::string name = new_name(std::move(body.name), taken_);
  const bool is_of_several = command.inputs.size() == 1;  // in the only file
  Findings own(is_of_several ? findings.input + ", " + name : findings.input, "");
  own.mesh_read = findings.mesh_read;
  RepairOptions repair = command.repair;
  repair.join_gaps = {};  // of all bodies together
  repair.certify.precision = Precision::float64;
  repair.progress = &run.progress;
  Operand operand;
  (void)with_findings(run, own, [&] {
    operand = make_operand(std::move(body.soup), {}, repair, run, own);
    return ExitCode::done;
  });
  end_operand(operand, own, run, facts);
  solids_.push_back(std::move(operand.solid));
  names_.push_back(std::move(name));
}

void Bodies::name_regions(const ConformingBodies& result) {
  for (const BodyRegion& region : result.regions) {
    if (region.bodies.size() == 1) {
      region_names_.push_back(names_[region.bodies[0]]);
      continue;
    }
    std::string name;
    for (const std::uint32_t body : region.bodies) {
      name += (name.empty() ? "" : "+") + names_[body];
    }
    region_names_.push_back(new_name(std::move(name), taken_));
  }
}

bool Bodies::is_empty(const ConformingBodies& result, std::uint32_t region) const {
  return solids_[result.regions[region - 1].bodies[0]].triangles.empty();
}

ConformingBodies divide_bodies(Bodies& bodies, const BodiesCommand& command, BodiesReport& report,
                               Run& run, Findings& findings) {
  BodiesOptions options;
  options.overlap = command.overlap;
  options.join_gaps = command.repair.join_gaps;
  options.precision = command.repair.certify.precision;
  options.progress = &run.progress;
  ConformingBodies result = conforming_bodies(bodies.solids(), options, report);
  bodies.name_regions(result);
  findings.repair.join_gaps = report.join_gaps;
  findings.repair.stages = report.stages;
  if (result.mesh.triangles.empty()) throw NoSolidError("no body encloses anything");
  return result;
}

void tell_of_bodies(const Bodies& bodies, const ConformingBodies& result,
                    const BodiesCommand& command, const BodiesFacts& facts, Run& run) {
  warn_of_common_grid(bodies.names(), facts.report.operands);
  run.report.set_section("bodies", bodies_section(bodies, result, command, facts));
  for (std::uint32_t r = 1; r <= result.regions.size(); ++r) {
    const BodyRegion& region = result.regions[r - 1];
    if (region.triangles > 0 || region.bodies.size() > 1 || bodies.is_empty(result, r)) continue;
    warn(bodies.name_of(r), {WarningCode::body_gone, "lies in other bodies, which have all of it"});
  }
}

std::string bodies_summary(const Bodies& bodies, const ConformingBodies& result,
                           const BodiesReport& report) {
  std::string lines;
  const auto neighbours = neighbours_of(result);
  const std::size_t shown = std::min(kMostRegionLines, result.regions.size());
  for (std::uint32_t r = 1; r <= shown; ++r) {
    lines += region_line(bodies, result, r, neighbours[r]);
  }
  if (const std::size_t more = result.regions.size() - shown; more > 0) {
    lines += fmt::format("          and {}: --report has all\n", number_of(more, "more region"));
  }
  if (report.overlaps > 0) {
    lines += fmt::format("overlaps  {} of bodies, volume {:.6g}\n",
                         number_of(report.overlaps, "set"), report.overlap_volume);
  }
  if (report.moves > 0) {
    lines +=
        fmt::format("rounding  {} of points and edges by up to {:.3g}, as faces met once rounded\n",
                    number_of(report.moves, "move"), report.moved_by);
  }
  return lines;
}

std::pair<TriangleSoup, Scene> as_scene(const ConformingBodies& result,
                                        const std::vector<std::string>& names) {
  TriangleSoup soup;
  Scene scene;
  std::size_t region = 0;
  for (const TriangleSoup& boundary : boundaries_of(result)) {
    const std::string& name = names[region++];
    if (boundary.triangles.empty()) continue;
    append_soup(soup, boundary);
    scene.instances.push_back({static_cast<std::uint32_t>(scene.meshes.size()), name, {}});
    scene.meshes.push_back({name, boundary.points.size(), boundary.triangles.size()});
  }
  return {std::move(soup), std::move(scene)};
}

std::string missing_guarantees(const BodiesReport& report) {
  if (report.passed()) return {};
  std::string faults;
  const auto add = [&](std::size_t count, std::string_view what, std::string_view how) {
    if (count == 0) return;
    faults += fmt::format("{}{} {}", faults.empty() ? "" : ", ", number_of(count, what), how);
  };
  add(report.pairs, "pair", "of triangles that intersect");
  add(report.turned_edges, "edge", "whose regions are not in order");
  add(report.turned_parts, "part", "turned inside out");
  return "not certified: " + faults +
         "; where faces of bodies nearly coincide, --join-gaps joins them";
}

}  // namespace meshrepair
