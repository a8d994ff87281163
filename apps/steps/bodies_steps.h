// SPDX-License-Identifier: MIT
// What meshbodies is asked for, and the steps from meshes to regions with common faces.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <boolean/bodies.h>
#include <mesh/attributes.h>
#include <mesh/scene.h>
#include <mesh/soup.h>

#include "options/command_line.h"
#include "program/program.h"
#include "report/findings.h"
#include "steps/boolean_steps.h"

namespace meshrepair {

// What tells the bodies of one file apart.
enum class BodiesBy { any, object, group, material };

struct BodiesCommand {
  std::vector<std::string> inputs;
  std::string output;
  BodiesBy by = BodiesBy::any;
  Overlap overlap = Overlap::first;
  RepairOptions repair;  // of what is no solid; and of all bodies which gaps are joined
};

// All options of meshbodies but IN and --output.
void add_bodies_command(CommandLine& app, BodiesCommand& command);

struct NamedSoup {
  std::string name;
  TriangleSoup soup;
};

// The bodies of one file, by the names that its triangles have: of objects, groups or materials; if
// any will do, by the first of these that has several. Triangles without a name are one body, which
// is called as `rest`. Throws InputError where there are no such names.
[[nodiscard]] std::vector<NamedSoup> named_bodies(TriangleSoup soup, const Attributes& attributes,
                                                  BodiesBy by, const std::string& rest);

class Bodies {
 public:
  // Repairs it where it is no solid, and appends its facts. `findings` are of its file.
  void add(NamedSoup body, const BodiesCommand& command, Run& run, const Findings& findings,
           Json& facts);

  [[nodiscard]] const std::vector<TriangleSoup>& solids() const { return solids_; }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  // "A", or "A+B" of an overlap. All names differ, and none is longer than formats have room for.
  void name_regions(const ConformingBodies& result);
  [[nodiscard]] const std::vector<std::string>& region_names() const { return region_names_; }
  [[nodiscard]] const std::string& name_of(std::uint32_t region) const {
    return region_names_[region - 1];
  }
  // Whether its first body was empty to begin with.
  [[nodiscard]] bool is_empty(const ConformingBodies& result, std::uint32_t region) const;

 private:
  std::vector<TriangleSoup> solids_;
  std::vector<std::string> names_;
  std::vector<std::string> region_names_;
  std::set<std::string> taken_;  // names
};

// conforming_bodies(); the findings get what was joined. Throws NoSolidError where nothing is left.
[[nodiscard]] ConformingBodies divide_bodies(Bodies& bodies, const BodiesCommand& command,
                                             BodiesReport& report, Run& run, Findings& findings);

struct BodiesFacts {
  BodiesReport report;
  std::vector<std::string> files;  // of the regions; an empty name: none; no names: of none
};
// The section "bodies" of the report, and a warning of bodies of which nothing is left.
void tell_of_bodies(const Bodies& bodies, const ConformingBodies& result,
                    const BodiesCommand& command, const BodiesFacts& facts, Run& run);

// Lines for people.
[[nodiscard]] std::string bodies_summary(const Bodies& bodies, const ConformingBodies& result,
                                         const BodiesReport& report);

// Each region that has faces as a mesh of its own, which is closed.
[[nodiscard]] std::pair<TriangleSoup, Scene> as_scene(const ConformingBodies& result,
                                                      const std::vector<std::string>& names);

// What the result does not hold, for people; empty: it holds all.
[[nodiscard]] std::string missing_guarantees(const BodiesReport& report);

}  // namespace meshrepair
