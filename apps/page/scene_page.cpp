// SPDX-License-Identifier: MIT
#include "page/scene_page.h"

#include <cstdint>
#include <utility>
#include <vector>

#include <base/stage_meter.h>

#include "options/show_requests.h"
#include "page/joined_check.h"
#include "program/program.h"
#include "report/findings.h"
#include "report/words.h"

namespace meshrepair {
namespace {

// All instances, as one soup.
struct PlacedScene {
  TriangleSoup soup;
  Attributes attributes;
  SurfaceCheck check;
  std::vector<ShownObject> objects;
  std::vector<std::uint32_t> kind_of;
};

std::string instance_name(const Scene& scene, const SceneInstance& instance) {
  return instance.name.empty() ? mesh_name(scene, instance.mesh) : instance.name;
}

// Of each mesh in its own frame: where it stands, rounding may make its walls touch.
std::vector<SurfaceCheck> checks_of(const SceneOnPage& given, const CheckOptions& options,
                                    Run& run) {
  std::vector<SurfaceCheck> checks;
  for (const TriangleSoup& mesh : meshes_of(given.soup, given.scene)) {
    checks.push_back(check_for_page(mesh, run, options));
  }
  return checks;
}

// The kinds of the triangles of each instance, one after the other.
std::vector<std::uint32_t> placed_kinds(const std::vector<std::uint32_t>& kinds,
                                        const Scene& scene) {
  std::vector<std::uint32_t> placed;
  if (kinds.empty()) return placed;
  std::vector<std::size_t> first = {0};
  for (const SceneMesh& mesh : scene.meshes) first.push_back(first.back() + mesh.triangles);
  for (const SceneInstance& instance : scene.instances) {
    placed.insert(placed.end(), kinds.begin() + static_cast<std::ptrdiff_t>(first[instance.mesh]),
                  kinds.begin() + static_cast<std::ptrdiff_t>(first[instance.mesh + 1]));
  }
  return placed;
}

PlacedScene placed_scene(const SceneOnPage& given, const std::vector<std::uint32_t>& kinds,
                         const CheckOptions& options, Run& run) {
  const Scene& scene = given.scene;
  const std::vector<SurfaceCheck> checks = checks_of(given, options, run);
  PlacedScene placed{given.soup, given.attributes, {}, {}, placed_kinds(kinds, scene)};
  place_instances(placed.soup, placed.attributes, scene);
  for (const SceneInstance& instance : scene.instances) {
    const SurfaceCheck& check = checks[instance.mesh];
    placed.objects.push_back(
        {instance_name(scene, instance), check.triangles, check.valid_solid()});
    append_check(placed_check(check, instance.placement), placed.check);
  }
  return placed;
}

ShownMesh shown_scene(std::string_view role, std::string name, PlacedScene& scene,
                      std::vector<PageKind> kinds) {
  return {role,
          std::move(name),
          scene.soup,
          std::move(scene.check),
          std::move(kinds),
          std::move(scene.kind_of),
          {},
          &scene.attributes,
          std::move(scene.objects)};
}

}  // namespace

void write_scene_page_stage(const HtmlRequest& request, const ScenePage& page, Run& run,
                            Findings& findings) {
  if (!request.wanted()) return;
  StageMeter meter(findings.repair.stages, nullptr);  // the check tells of its own stages
  meter.begin("html");
  const RepairExplanation& explanation = findings.repair.explanation;
  const std::string name = page_name(findings.input, findings.input_name());
  PageContent content{page.result ? "repair" : "check", page.up, findings.unit};
  PlacedScene input = placed_scene(page.input, numbers_of(explanation.fates), page.check, run);
  PlacedScene result;
  if (page.result) {
    content.meshes.push_back(shown_scene("input", name, input, page_kinds(kinds_of_fates())));
    result = placed_scene(*page.result, numbers_of(explanation.origins), page.check, run);
    content.meshes.push_back(shown_scene("result",
                                         page_name(findings.output, findings.output_name()), result,
                                         page_kinds(kinds_of_origins())));
  } else {
    content.meshes.push_back(shown_scene("input", name, input, {}));
  }
  content.inputs = {findings.input};
  content.report = page_sections(findings);
  write_page(request, std::move(content), run);
}

}  // namespace meshrepair
