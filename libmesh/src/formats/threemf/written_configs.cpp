// SPDX-License-Identifier: MIT
#include "written_configs.h"

#include <unordered_map>
#include <unordered_set>

#include "formats/common/part_names.h"

namespace meshrepair {
namespace {

class ConfigNumbers {
 public:
  ConfigNumbers(const KeptGraph& graph, const std::vector<std::uint32_t>& ids, const Scene& scene)
      : graph_(graph), ids_(ids), scene_(scene) {
    for (std::uint32_t i = 0; i < graph.objects.size(); ++i) {
      if (graph.objects[i].part == 0) number_of_.try_emplace(graph.objects[i].id, i);
    }
  }

  std::vector<WrittenObject> run(const ProjectConfig& config) {
    std::vector<WrittenObject> now;
    for (const ProjectObject& object : config.objects()) {
      now.emplace_back();
      const auto found = number_of_.find(object.id);
      if (found == number_of_.end()) continue;
      fill(object, found->second, now.back());
      number_of_.erase(found);  // another of the same id is nothing
    }
    return now;
  }

 private:
  [[nodiscard]] std::size_t triangles_of(const KeptObject& object) const {
    return object.mesh == kNone ? 0 : scene_.meshes[object.mesh].triangles;
  }

  void fill(const ProjectObject& object, std::uint32_t number, WrittenObject& now) const {
    now.id = ids_[number];
    now.volumes.resize(object.volumes.size());
    const KeptObject& kept = graph_.objects[number];
    if (kept.is_split) return fill_ranges(kept, now);
    std::size_t meshes = 0;
    fill_parts(object, number, meshes, now);
  }

  // Its meshes are written one after the other.
  void fill_ranges(const KeptObject& kept, WrittenObject& now) const {
    for (const KeptReference& component : kept.components) {
      const KeptObject& range = graph_.objects[component.object];
      const std::size_t triangles = triangles_of(range);
      if (range.volume < now.volumes.size()) {
        now.volumes[range.volume] = {triangles > 0, kNone, now.triangles, triangles};
      }
      now.triangles += triangles;
    }
  }

  // In the order in which they were read.
  void fill_parts(const ProjectObject& object, std::uint32_t number, std::size_t& meshes,
                  WrittenObject& now) const {
    const KeptObject& kept = graph_.objects[number];
    if (kept.mesh != kNone) {
      const std::uint32_t volume = object.volume_of(meshes, kept.id);
      ++meshes;
      const std::size_t triangles = triangles_of(kept);
      now.triangles += triangles;
      if (volume < now.volumes.size() && !now.volumes[volume].is_there) {
        now.volumes[volume] = {triangles > 0, ids_[number], 0, triangles};
      }
    }
    for (const KeptReference& component : kept.components) {
      fill_parts(object, component.object, meshes, now);
    }
  }

  const KeptGraph& graph_;
  const std::vector<std::uint32_t>& ids_;
  const Scene& scene_;
  std::unordered_map<std::uint32_t, std::uint32_t> number_of_;  // objects of the first part
};

}  // namespace

std::string written_config(const KeptPackage& kept, const ProjectConfig& config,
                           const std::vector<std::uint32_t>& ids, const Scene& scene) {
  std::unordered_set<std::string> keys;
  for (const KeptPackage::Part& part : kept.parts) keys.insert(part_key(part.name));
  return config.written(ConfigNumbers(*kept.graph, ids, scene).run(config),
                        [&](const std::string& name) { return keys.contains(part_key(name)); });
}

}  // namespace meshrepair
