// SPDX-License-Identifier: MIT
#include "model_instances.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <base/progress.h>
#include <mesh/append_soup.h>
#include <mesh/mesh_limits.h>
#include <mesh/read_guard.h>

#include "common/model_values.h"
#include "volume_ranges.h"

namespace meshrepair {
namespace {

constexpr std::size_t kDeepestComponent = 64;

// Triangles and points that copies may make beyond what is in the file: a full plate of copies of
// one mesh, not more.
constexpr std::uint64_t kCopiesAlways = 10'000'000;
constexpr std::uint64_t kCopiesPerByte = 64;
constexpr std::uint64_t kMostCopies = 200'000'000;

struct MeshTotal {
  static constexpr std::uint64_t kMany = std::uint64_t{1} << 48;

  std::uint64_t points = 0, triangles = 0;
  std::uint64_t steps = 0;  // to place it
  std::size_t height = 0;   // objects one inside the other

  void add(const MeshTotal& other) {
    points = std::min(points + other.points, kMany);
    triangles = std::min(triangles + other.triangles, kMany);
    steps = std::min(steps + other.steps, kMany);
    height = std::max(height, other.height);
  }
};

class InstancePlacer {
 public:
  InstancePlacer(const MeshSource& source, const std::vector<ModelPart>& parts)
      : source_(source), parts_(parts), cancel_(source.options.progress) {
    for (const ModelPart& part : parts) {
      known_.emplace_back(part.objects.size());
      result_.mesh_of_object.emplace_back(part.objects.size(), kNone);
    }
  }

  InstanceResult run() {
    const std::vector<ObjectReference> items = items_of_build();
    MeshTotal total;
    for (const ObjectReference& item : items) total.add(count(item, 1));
    require_sane(total);
    result_.soup.points.reserve(static_cast<std::size_t>(total.points));
    result_.soup.triangles.reserve(static_cast<std::size_t>(total.triangles));
    result_.none_printed = std::none_of(items.begin(), items.end(), is_printed);
    for (const ObjectReference& item : items) {
      if (const auto number = number_of(item)) {
        Around around{item.part, *number, nullptr, groups_++, 0, is_printed(item)};
        place(item.part, *number, placement_in(0, item), {}, VolumeRole::model, around);
      }
    }
    end_volumes();
    if (source_.options.by_mesh) keep_graph(items);
    return std::move(result_);
  }

 private:
  // What is known of an object.
  struct Known {
    enum class State : char { fresh, open, done };
    State state = State::fresh;
    MeshTotal total;
  };
  // The object around that has a name.
  struct Named {
    std::uint32_t part = kNone, object = kNone;
  };
  // The object that volumes belong to: that of the item, or within it the one that a project knows.
  struct Around {
    std::uint32_t part = 0, object = 0;
    const ProjectObject* project = nullptr;
    std::uint32_t group = 0;
    std::size_t meshes = 0;  // before in it
    bool printed = true;
  };

  static bool is_printed(const ObjectReference& item) {
    return !item.marks || (item.marks->printable != "0" && item.marks->printable != "false");
  }

  [[nodiscard]] std::vector<ObjectReference> items_of_build() const {
    const ModelPart& part = parts_.front();
    if (!part.items.empty()) return part.items;
    std::vector<char> is_component(part.objects.size(), 0);
    for (const ModelObject& object : part.objects) {
      for (const ObjectReference& component : object.components) {
        const auto number = component.part == 0 ? number_of(component) : std::nullopt;
        if (number) is_component[*number] = 1;
      }
    }
    std::vector<ObjectReference> items;
    for (std::uint32_t i = 0; i < part.objects.size(); ++i) {
      if (is_component[i] == 0) items.push_back({0, part.objects[i].id, {}, nullptr});
    }
    return items;
  }

  [[nodiscard]] std::optional<std::uint32_t> number_of(const ObjectReference& reference) const {
    if (reference.part >= parts_.size() || reference.object == kNone) return std::nullopt;
    const auto& numbers = parts_[reference.part].object_of_id;
    const auto found = numbers.find(reference.object);
    return found == numbers.end() ? std::nullopt : std::optional(found->second);
  }

  // What an object becomes. Each is looked into once, however often it is named.
  MeshTotal count(const ObjectReference& reference, std::size_t depth) {
    const auto number = number_of(reference);
    if (!number) {
      ++result_.missing;
      return {0, 0, 1, 0};
    }
    const ModelObject& object = parts_[reference.part].objects[*number];
    Known& known = known_[reference.part][*number];
    if (known.state == Known::State::open) {
      source_.fail("its object " + std::to_string(object.id) + " is a component of itself");
    }
    // One that was looked into before is counted with what is inside.
    const bool is_known = known.state == Known::State::done;
    if (depth + (is_known ? known.total.height : 0) > kDeepestComponent) {
      source_.fail("its components are nested too deep");
    }
    if (is_known) return known.total;
    cancel_.tick();
    known.state = Known::State::open;
    MeshTotal total = {object.mesh.points.size(), object.mesh.triangles.size(), 0, 0};
    in_file_.add(total);
    for (const ObjectReference& component : object.components) {
      total.add(count(component, depth + 1));
    }
    if (total.triangles == 0) total = {0, 0, 0, total.height};
    ++total.steps;
    ++total.height;
    in_file_.steps += object.components.size();
    known.total = total;
    known.state = Known::State::done;
    return total;
  }

  void require_sane(const MeshTotal& total) const {
    ReadGuard(source_).require(total.triangles);
    const std::uint64_t copies =
        std::min(kCopiesAlways + kCopiesPerByte * source_.bytes.size(), kMostCopies);
    if (total.triangles > in_file_.triangles + copies || total.points > in_file_.points + copies ||
        total.steps > in_file_.steps + copies) {
      source_.fail("its components would make " + counted(total.triangles, "triangle") + " of " +
                   std::to_string(in_file_.triangles));
    }
    require_points(total.points, source_.name);
    require_triangles(total.triangles, source_.name);
  }

  void place(std::uint32_t part, std::uint32_t number, const Placement& placement, Named named,
             VolumeRole role, Around& around) {
    if (known_[part][number].total.triangles == 0) return;
    cancel_.tick();
    const ModelObject& object = parts_[part].objects[number];
    if (object.project != nullptr && around.project == nullptr) {
      Around inner{part, number, object.project, groups_++, 0, around.printed};
      return place_inside(part, number, placement, named, role, inner);
    }
    place_inside(part, number, placement, named, role, around);
  }

  void place_inside(std::uint32_t part, std::uint32_t number, const Placement& placement,
                    Named named, VolumeRole role, Around& around) {
    const ModelObject& object = parts_[part].objects[number];
    if (role == VolumeRole::model) role = object.role;
    if (!object.name.empty()) named = {part, number};
    if (!object.mesh.triangles.empty()) add_mesh(part, number, placement, named, role, around);
    for (const ObjectReference& component : object.components) {
      const auto inner = number_of(component);
      if (!inner) continue;
      place(component.part, *inner, placement_in(part, component).then(placement), named, role,
            around);
    }
  }

  // Of objects that are or hold a mesh; those that others have as components come before these.
  void keep_graph(const std::vector<ObjectReference>& items) {
    std::vector<std::vector<std::uint32_t>> kept;
    for (const ModelPart& part : parts_) kept.emplace_back(part.objects.size(), kNone);
    for (const ObjectReference& item : items) keep_reference(0, item, kept, result_.graph.items);
    result_.graph.build_uuid = parts_.front().build_uuid;
  }

  void keep_reference(std::uint32_t part, const ObjectReference& reference,
                      std::vector<std::vector<std::uint32_t>>& kept,
                      std::vector<KeptReference>& to) {
    const auto number = number_of(reference);
    if (!number || known_[reference.part][*number].total.triangles == 0) return;
    std::uint32_t& object = kept[reference.part][*number];
    if (object == kNone) object = keep_object(reference.part, *number, kept);
    to.push_back({object, placement_in(part, reference), reference.marks});
  }

  std::uint32_t keep_object(std::uint32_t part, std::uint32_t number,
                            std::vector<std::vector<std::uint32_t>>& kept) {
    const ModelObject& object = parts_[part].objects[number];
    KeptObject fresh{object.name, result_.mesh_of_object[part][number], {}, object.marks};
    fresh.part = part;
    fresh.id = object.id;
    fresh.is_split = object.is_split;
    fresh.volume = object.volume;
    for (const ObjectReference& component : object.components) {
      keep_reference(part, component, kept, fresh.components);
    }
    result_.graph.objects.push_back(std::move(fresh));
    return static_cast<std::uint32_t>(result_.graph.objects.size() - 1);
  }

  // In the unit of the part that names it.
  [[nodiscard]] Placement placement_in(std::uint32_t part, const ObjectReference& reference) const {
    const auto unit_of = [&](std::uint32_t one) {
      return parts_[one].unit.value_or(LengthUnit::millimeter);
    };
    const LengthUnit from = unit_of(reference.part), to = unit_of(part);
    if (from == to) return reference.placement;
    Placement scale;
    scale.linear *= unit_scale(from, to);
    return scale.then(reference.placement);
  }

  void add_mesh(std::uint32_t part, std::uint32_t number, const Placement& placement, Named named,
                VolumeRole role, Around& around) {
    const ModelObject& object = parts_[part].objects[number];
    std::string name = object.name;
    if (around.project != nullptr && object.volume == kNone) {
      const std::uint32_t known = around.project->volume_of(around.meshes, object.id);
      if (known != kNone) {
        const ProjectVolume& volume = around.project->volumes[known];
        if (role == VolumeRole::model) role = volume.role;
        if (!volume.name.empty()) name = volume.name;
      }
    }
    ++around.meshes;
    ModelVolume& volume = volume_at(part, number, name, role, around);
    const bool is_new = volume.copies++ == 0;
    if (is_new) volume.triangles = object.mesh.triangles.size();
    if (volume.fate == VolumeFate::left_out) return;
    if (source_.options.by_mesh) {
      if (name.empty() && named.object != kNone)
        name = parts_[named.part].objects[named.object].name;
      return add_instance(part, number, placement, named, name);
    }
    result_.placed.push_back({number_of_volume_, around.group, result_.soup.triangles.size(),
                              object.mesh.triangles.size()});
    append(part, number, placement, named);
  }

  // Sets number_of_volume_, too.
  ModelVolume& volume_at(std::uint32_t part, std::uint32_t number, const std::string& name,
                         VolumeRole role, const Around& around) {
    const bool printed = around.printed || result_.none_printed;
    const auto key = std::tuple(around.part, around.object, part, number, role, printed);
    const auto fresh = static_cast<std::uint32_t>(result_.volumes.size());
    const auto [found, is_new] = volume_numbers_.try_emplace(key, fresh);
    number_of_volume_ = found->second;
    if (is_new) {
      const ProjectObject* const project = around.project;
      const bool has_name = project != nullptr && !project->name.empty();
      const std::string& object =
          has_name ? project->name : parts_[around.part].objects[around.object].name;
      const bool has_words = !name.empty() || !object.empty();
      const std::uint32_t own_id = parts_[part].objects[number].id;
      const std::uint32_t id =
          is_range_id(own_id) ? parts_[around.part].objects[around.object].id : own_id;
      const std::string by_id = "object " + std::to_string(id);
      result_.volumes.push_back(
          {has_words ? name : by_id, object, role, printed, 0, 0, fate_of(role, printed)});
    }
    return result_.volumes[number_of_volume_];
  }

  [[nodiscard]] VolumeFate fate_of(VolumeRole role, bool printed) const {
    if (source_.options.by_mesh) return VolumeFate::separate;
    if (!printed) return VolumeFate::left_out;
    if (role == VolumeRole::model) return VolumeFate::joined;
    if (role != VolumeRole::negative) return VolumeFate::left_out;
    switch (source_.options.negative) {
      case NegativeVolumes::drop:
        break;
      case NegativeVolumes::keep:
        return VolumeFate::joined;
      case NegativeVolumes::subtract:
        return VolumeFate::subtracted;
    }
    return VolumeFate::left_out;
  }

  void end_volumes() {
    const auto is_subtracted = [](const ModelVolume& volume) {
      return volume.fate == VolumeFate::subtracted;
    };
    auto& volumes = result_.volumes;
    if (std::none_of(volumes.begin(), volumes.end(), is_subtracted)) result_.placed = {};
    result_.none_printed = result_.none_printed && !volumes.empty();
    const auto& objects = parts_.front().objects;
    const bool is_project =
        std::any_of(objects.begin(), objects.end(),
                    [](const ModelObject& object) { return object.project != nullptr; });
    const bool is_plain = std::all_of(volumes.begin(), volumes.end(),
                                      [](const ModelVolume& volume) { return volume.is_plain(); });
    if (is_plain && !is_project && !result_.none_printed) volumes = {};
  }

  // The mesh itself once, and where it stands.
  void add_instance(std::uint32_t part, std::uint32_t number, const Placement& placement,
                    Named named, const std::string& name) {
    Scene& scene = result_.scene;
    std::uint32_t& mesh = result_.mesh_of_object[part][number];
    if (mesh == kNone) {
      mesh = static_cast<std::uint32_t>(scene.meshes.size());
      const std::size_t points = result_.soup.points.size();
      const std::size_t triangles = result_.soup.triangles.size();
      append(part, number, {}, named);
      scene.meshes.push_back(
          {name, result_.soup.points.size() - points, result_.soup.triangles.size() - triangles});
    }
    scene.instances.push_back({mesh, name, placement});
  }

  void append(std::uint32_t part, std::uint32_t number, const Placement& placement, Named named) {
    result_.instances.push_back({part, number, named.object, named.part,
                                 result_.soup.triangles.size(), placement.mirrors()});
    append_soup(result_.soup, parts_[part].objects[number].mesh, placement);
  }

  const MeshSource& source_;
  const std::vector<ModelPart>& parts_;
  using VolumeKey =
      std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, VolumeRole, bool>;

  std::vector<std::vector<Known>> known_;
  MeshTotal in_file_;
  std::uint32_t groups_ = 0;
  std::map<VolumeKey, std::uint32_t> volume_numbers_;
  std::uint32_t number_of_volume_ = 0;  // the last one
  InstanceResult result_;
  CancelCheck cancel_;
};

}  // namespace

InstanceResult place_instances(const MeshSource& source, const std::vector<ModelPart>& parts) {
  return InstancePlacer(source, parts).run();
}

}  // namespace meshrepair
