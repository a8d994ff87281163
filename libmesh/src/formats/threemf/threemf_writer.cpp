// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <base/error.h>
#include <mesh/edge_table.h>

#include "common/xml_text.h"
#include "formats/common/part_names.h"
#include "formats/common/text_writer.h"
#include "kept_parts.h"
#include "package_parts.h"
#include "package_writer.h"
#include "threemf_io.h"
#include "written_configs.h"
#include "written_properties.h"
#include "zip_writer.h"

namespace meshrepair {
namespace {

constexpr std::string_view kCoreSpace = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
constexpr std::string_view kMaterialSpace =
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02";
constexpr std::string_view kProductionSpace =
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
constexpr std::string_view kSetSpace =
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07";
constexpr std::string_view kDescription = "Description";

void require_writable(const TriangleSoup& soup) {
  constexpr std::size_t kMost = std::size_t{1} << 31;
  if (std::max(soup.points.size(), soup.triangles.size()) >= kMost) {
    throw OutputError("3MF holds fewer than 2147483648 points and triangles; write another format");
  }
  const bool is_finite = std::all_of(soup.points.begin(), soup.points.end(),
                                     [](const Vec3d& point) { return point.allFinite(); });
  if (!is_finite) {
    throw OutputError("3MF holds no coordinate that is not a finite number; write another format");
  }
}

// The model part, as text.
class ModelWriter {
 public:
  ModelWriter(const TriangleSoup& soup, const SoupExtras& extras, const KeptPackage* kept)
      : soup_(soup), extras_(extras), attributes_(extras.attributes), kept_(kept) {
    material_ = free_prefix("m", kMaterialSpace);
    production_ = free_prefix("p", kProductionSpace);
    sets_ = free_prefix("t", kSetSpace);
    collect_metadata();
    const std::uint32_t first_id = keep_ids();
    if (attributes_ != nullptr) {
      properties_ = write_properties(soup, *attributes_, kept, material_, first_id);
    }
    properties_.next_id = std::max(properties_.next_id, first_id);
  }

  std::string run() {
    xml_ = kXmlDeclaration;
    open_model();
    write_metadata();
    xml_ += "<resources>\n" + properties_.resources;
    std::vector<KeptReference> items = write_objects();
    if (extras_.origin) {
      for (KeptReference& item : items) item.placement.offset += *extras_.origin;
    }
    xml_ += "</resources>\n<build";
    if (const KeptGraph* const graph = kept_graph()) append_uuid(graph->build_uuid);
    xml_ += ">\n";
    for (const KeptReference& item : items) write_reference("item", item);
    xml_ += "</build>\n</model>\n";
    return std::move(xml_);
  }

  [[nodiscard]] const std::vector<WrittenPicture>& pictures() const { return properties_.pictures; }
  // Parts that objects have for their thumbnails, once the model is written.
  [[nodiscard]] const std::vector<std::string>& thumbnails() const { return thumbnails_; }

  // Of a part that was kept, once the model is written: null, or what names objects.
  [[nodiscard]] const ProjectConfig* config_of(const KeptPackage::Part& part) const {
    const auto& configs = kept_->configs;
    const auto config = std::find_if(configs.begin(), configs.end(),
                                     [&](const auto& one) { return one.name == part.name; });
    return config == configs.end() ? nullptr : config->text.get();
  }

  // Of the scene that was written; nothing if there was none, as it would be wrong.
  [[nodiscard]] std::optional<std::string> text_of(const ProjectConfig& config) const {
    if (kept_graph() == nullptr) return std::nullopt;
    return written_config(*kept_, config, written_, *extras_.scene);
  }

 private:
  // Objects keep theirs as far as no other has the same. Returns what is free.
  std::uint32_t keep_ids() {
    constexpr std::uint32_t kMost = std::uint32_t{1} << 30;
    const KeptGraph* const graph = kept_graph();
    std::uint32_t last = 0;
    if (graph == nullptr) return 1;
    std::unordered_set<std::uint32_t> taken;
    for (const KeptObject& object : graph->objects) {
      const bool is_kept = object.id > 0 && object.id < kMost && taken.insert(object.id).second;
      written_.push_back(is_kept ? object.id : kNone);
      if (is_kept) last = std::max(last, object.id);
    }
    return last + 1;
  }

  // This letter, or several, unless other metadata have it.
  [[nodiscard]] std::string free_prefix(const std::string& letter, std::string_view space) const {
    std::string prefix = letter;
    const auto is_taken = [&] {
      return kept_ != nullptr && std::any_of(kept_->namespaces.begin(), kept_->namespaces.end(),
                                             [&](const ModelNamespace& one) {
                                               return one.prefix == prefix && one.space != space;
                                             });
    };
    while (is_taken()) prefix += letter;
    return prefix;
  }

  void open_model() {
    xml_ += "<model";
    const std::optional<LengthUnit> unit =
        kept_ != nullptr && !extras_.unit ? kept_->unit : extras_.unit;
    append_xml_attribute(xml_, "unit", unit_name(unit.value_or(LengthUnit::millimeter)));
    append_xml_attribute(xml_, "xml:lang", "en-US");
    append_xml_attribute(xml_, "xmlns", kCoreSpace);
    if (!properties_.resources.empty()) {
      append_xml_attribute(xml_, "xmlns:" + material_, kMaterialSpace);
      declared_.emplace(material_, kMaterialSpace);
    }
    if (has_uuids()) {
      append_xml_attribute(xml_, "xmlns:" + production_, kProductionSpace);
      declared_.emplace(production_, kProductionSpace);
    }
    if (has_groups()) {
      append_xml_attribute(xml_, "xmlns:" + sets_, kSetSpace);
      declared_.emplace(sets_, kSetSpace);
    }
    if (has_prusa_paint()) {
      append_xml_attribute(xml_, "xmlns:" + std::string(kPrusaPrefix), kPrusaSpace);
      declared_.emplace(kPrusaPrefix, kPrusaSpace);
    }
    if (kept_ != nullptr) {
      for (const ModelNamespace& one : kept_->namespaces) {
        if (one.prefix.empty() || one.space.empty() || !is_in_use(one.prefix)) continue;
        if (!declared_.emplace(one.prefix, one.space).second) continue;
        append_xml_attribute(xml_, "xmlns:" + one.prefix, one.space);
      }
    }
    xml_ += ">\n";
  }

  [[nodiscard]] bool has_groups() const {
    return attributes_ != nullptr && !attributes_->groups.empty();
  }

  // Of the scene that is written; null: none was kept.
  [[nodiscard]] const KeptGraph* kept_graph() const {
    const bool has_one = extras_.scene != nullptr && kept_ != nullptr && kept_->graph;
    return has_one ? &*kept_->graph : nullptr;
  }

  [[nodiscard]] bool has_uuids() const {
    const KeptGraph* const graph = kept_graph();
    if (graph == nullptr) return false;
    const auto has_one = [](const auto& entry) {
      return entry.marks && !entry.marks->uuid.empty();
    };
    return !graph->build_uuid.empty() ||
           std::any_of(graph->items.begin(), graph->items.end(), has_one) ||
           std::any_of(graph->objects.begin(), graph->objects.end(), [&](const KeptObject& object) {
             return has_one(object) ||
                    std::any_of(object.components.begin(), object.components.end(), has_one);
           });
  }

  [[nodiscard]] bool has_prusa_paint() const {
    return attributes_ != nullptr &&
           std::any_of(attributes_->paints.begin(), attributes_->paints.end(),
                       [](const auto& paint) { return paint.name.starts_with(kPrusaPrefix); });
  }

  void append_uuid(const std::string& uuid) {
    if (!uuid.empty()) append_xml_attribute(xml_, production_ + ":UUID", uuid);
  }

  void collect_metadata() {
    if (kept_ == nullptr) return;
    const auto collect = [this](const std::vector<ModelMetadata>& list) {
      for (const ModelMetadata& one : list) metadata_.push_back(&one);
    };
    const auto collect_marks = [&](const auto& list) {
      for (const auto& one : list) {
        if (one.marks) collect(one.marks->metadata);
      }
    };
    collect(kept_->metadata);
    const KeptGraph* const graph = kept_graph();
    if (graph == nullptr) return;
    collect_marks(graph->objects);
    collect_marks(graph->items);
  }

  [[nodiscard]] bool is_in_use(const std::string& prefix) const {
    return std::any_of(metadata_.begin(), metadata_.end(), [&](const ModelMetadata* one) {
      return one->name.starts_with(prefix + ":") || one->type.starts_with(prefix + ":");
    });
  }

  // It has a name that means the same here.
  [[nodiscard]] bool has_name(const ModelMetadata& one) const {
    const std::size_t colon = one.name.find(':');
    if (colon == std::string::npos) return !one.name.empty();
    const auto space = declared_.find(one.name.substr(0, colon));
    return space != declared_.end() && space->second == one.space;
  }

  // Names are to be different; comments go behind the description.
  void write_metadata() {
    std::string lines;
    for (const std::string& comment : extras_.comments)
      lines += (lines.empty() ? "" : "\n") + comment;
    std::unordered_set<std::string> names;
    if (kept_ != nullptr) {
      for (ModelMetadata one : kept_->metadata) {
        if (!has_name(one) || !names.insert(one.name).second) continue;
        if (one.name == kDescription && one.value.find(lines) == std::string::npos) {
          one.value += (one.value.empty() ? "" : "\n") + lines;
        }
        append_metadatum(xml_, one);
      }
    }
    if (!lines.empty() && !names.contains(std::string(kDescription))) {
      append_metadatum(xml_, {std::string(kDescription), lines, {}, {}});
    }
  }

  static void append_metadatum(std::string& xml, const ModelMetadata& one) {
    xml += "<metadata";
    append_xml_attribute(xml, "name", one.name);
    if (!one.preserve.empty()) append_xml_attribute(xml, "preserve", one.preserve);
    if (!one.type.empty()) append_xml_attribute(xml, "type", one.type);
    xml += '>';
    append_xml_text(xml, one.value);
    xml += "</metadata>\n";
  }

  // Of an object or an item; empty if it has none.
  [[nodiscard]] std::string metadata_group(const ModelMarks* marks) const {
    std::string lines;
    std::unordered_set<std::string> names;
    if (marks == nullptr) return lines;
    for (const ModelMetadata& one : marks->metadata) {
      if (has_name(one) && names.insert(one.name).second) append_metadatum(lines, one);
    }
    return lines.empty() ? lines : "<metadatagroup>\n" + lines + "</metadatagroup>\n";
  }

  // Of the object, if all triangles are of one.
  [[nodiscard]] std::string name_of_object() const {
    if (attributes_ == nullptr || attributes_->objects.empty()) return {};
    const auto& labels = attributes_->objects.of_triangle;
    std::uint32_t only = kNone;
    for (const std::uint32_t label : labels) {
      if (label == kNone) continue;
      if (only != kNone && label != only) return {};
      only = label;
    }
    return only == kNone ? std::string() : attributes_->objects.names[only];
  }

  // Returns what is to be built, by the ids of objects.
  std::vector<KeptReference> write_objects() {
    if (extras_.scene == nullptr) {
      const MeshRange all{0, soup_.points.size(), 0, soup_.triangles.size()};
      return {{write_mesh(all, name_of_object(), nullptr, kNone), {}, nullptr}};
    }
    const Scene& scene = *extras_.scene;
    const KeptGraph* const graph = kept_graph();
    const std::vector<std::uint32_t> owners = owners_of(graph, scene.meshes.size());
    std::vector<std::uint32_t> ids(scene.meshes.size(), kNone);  // of meshes
    MeshRange range;
    for (std::size_t m = 0, next = 0; m < scene.meshes.size(); m = next) {
      const std::uint32_t owner = owners[m];
      range = {range.point_end, range.point_end, range.end, range.end};
      do {
        range.point_end += scene.meshes[next].points;
        range.end += scene.meshes[next].triangles;
        ++next;
      } while (owner != kNone && next < owners.size() && owners[next] == owner);
      std::uint32_t& id = owner == kNone ? ids[m] : written_[owner];
      if (range.end == range.first) {
        id = kNone;
      } else if (owner == kNone) {
        id = write_mesh(range, scene.meshes[m].name, nullptr, kNone);
      } else {
        const KeptObject& object = graph->objects[owner];
        id = write_mesh(range, object.name, object.marks.get(), id);
      }
      ids[m] = id;
    }
    return graph != nullptr ? write_graph(*graph, ids) : items_of(scene, ids);
  }

  // Of each mesh the object of the graph that is written with it: one without components, or all
  // that its ranges became, which stand one after the other.
  static std::vector<std::uint32_t> owners_of(const KeptGraph* graph, std::size_t meshes) {
    std::vector<std::uint32_t> owners(meshes, kNone);
    const std::size_t count = graph == nullptr ? 0 : graph->objects.size();
    for (std::uint32_t i = 0; i < count; ++i) {
      const KeptObject& object = graph->objects[i];
      if (object.mesh < meshes && object.components.empty()) owners[object.mesh] = i;
      if (!object.is_split) continue;
      for (const KeptReference& range : object.components) {
        const std::uint32_t mesh = graph->objects[range.object].mesh;
        if (mesh < meshes) owners[mesh] = i;
      }
    }
    return owners;
  }

  static std::vector<KeptReference> items_of(const Scene& scene,
                                             const std::vector<std::uint32_t>& ids) {
    std::vector<KeptReference> items;
    for (const SceneInstance& instance : scene.instances) {
      if (ids[instance.mesh] != kNone)
        items.push_back({ids[instance.mesh], instance.placement, nullptr});
    }
    return items;
  }

  // Objects that hold nothing any more are left out.
  std::vector<KeptReference> write_graph(const KeptGraph& graph,
                                         const std::vector<std::uint32_t>& ids) {
    const auto numbered = [&](const std::vector<KeptReference>& references) {
      std::vector<KeptReference> list;
      for (const KeptReference& one : references) {
        if (written_[one.object] != kNone)
          list.push_back({written_[one.object], one.placement, one.marks});
      }
      return list;
    };
    for (std::size_t i = 0; i < graph.objects.size(); ++i) {
      const KeptObject& object = graph.objects[i];
      if (object.is_split) continue;
      std::vector<KeptReference> components = numbered(object.components);
      const std::uint32_t mesh = object.mesh == kNone ? kNone : ids[object.mesh];
      if (components.empty()) {
        written_[i] = mesh;
        continue;
      }
      // The format has no objects with both.
      if (mesh != kNone) components.push_back({mesh, {}, nullptr});
      written_[i] = open_object(object.name, object.marks.get(), written_[i]);
      xml_ += ">\n" + metadata_group(object.marks.get()) + "<components>\n";
      for (const KeptReference& component : components) write_reference("component", component);
      xml_ += "</components>\n</object>\n";
    }
    return numbered(graph.items);
  }

  void write_reference(std::string_view element, const KeptReference& reference) {
    xml_ += '<';
    xml_ += element;
    append_xml_attribute(xml_, "objectid", std::to_string(reference.object));
    if (const Placement& placement = reference.placement; !placement.is_identity()) {
      std::string numbers;
      for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 3; ++column) {
          if (!numbers.empty()) numbers += ' ';
          append_number(numbers,
                        row < 3 ? placement.linear(column, row) : placement.offset[column]);
        }
      }
      append_xml_attribute(xml_, "transform", numbers);
    }
    const bool is_item = element == "item";
    if (reference.marks) append_marks(*reference.marks, is_item);
    const std::string group = is_item ? metadata_group(reference.marks.get()) : std::string();
    xml_ += group.empty() ? "/>\n" : ">\n" + group + "</item>\n";
  }

  // All but the end of its first tag. Returns its id: this one, or a new one where it is kNone.
  std::uint32_t open_object(const std::string& name, const ModelMarks* marks, std::uint32_t id) {
    if (id == kNone) id = properties_.next_id++;
    xml_ += "<object";
    append_xml_attribute(xml_, "id", std::to_string(id));
    const bool has_type = marks != nullptr && !marks->type.empty();
    append_xml_attribute(xml_, "type", has_type ? marks->type : "model");
    if (!name.empty()) append_xml_attribute(xml_, "name", name);
    if (marks == nullptr) return id;
    if (is_thumbnail(marks->thumbnail)) {
      thumbnails_.push_back(marks->thumbnail);
      append_xml_attribute(xml_, "thumbnail", uri_of_part(marks->thumbnail));
    }
    append_marks(*marks, true);
    return id;
  }

  // Components have UUIDs alone.
  void append_marks(const ModelMarks& marks, bool with_all) {
    if (with_all && !marks.part_number.empty()) {
      append_xml_attribute(xml_, "partnumber", marks.part_number);
    }
    if (with_all && !marks.printable.empty()) {
      append_xml_attribute(xml_, "printable", marks.printable);
    }
    append_uuid(marks.uuid);
  }

  // A picture that is in the package, or what the model calls so.
  [[nodiscard]] bool is_thumbnail(const std::string& name) const {
    const std::string key = part_key(name), extension = extension_of_part(name);
    const auto has_key = [&](const std::string& other) { return part_key(other) == key; };
    const bool is_named = std::any_of(kept_->of_model.begin(), kept_->of_model.end(),
                                      [&](const auto& one) { return has_key(one.target); });
    if (name.empty() || is_named) return is_named;
    const bool is_picture = extension == "png" || extension == "jpg" || extension == "jpeg";
    return is_picture && std::any_of(kept_->parts.begin(), kept_->parts.end(),
                                     [&](const auto& one) { return has_key(one.name); });
  }

  // Of the soup.
  struct MeshRange {
    std::size_t first_point = 0, point_end = 0;
    std::size_t first = 0, end = 0;  // triangles
  };

  std::uint32_t write_mesh(const MeshRange& range, const std::string& name, const ModelMarks* marks,
                           std::uint32_t kept_id) {
    const std::uint32_t id = open_object(name, marks, kept_id);
    const auto& property = properties_.of_object;
    if (property.group != kNone) {
      append_xml_attribute(xml_, "pid", std::to_string(property.group));
      append_xml_attribute(xml_, "pindex", std::to_string(property.index[0]));
    }
    xml_ += ">\n" + metadata_group(marks) + "<mesh>\n<vertices>\n";
    append_lines(xml_, range.point_end - range.first_point, [&](std::string& lines, std::size_t p) {
      const Vec3d& point = soup_.points[range.first_point + p];
      lines += "<vertex x=\"";
      append_number(lines, point.x());
      lines += "\" y=\"";
      append_number(lines, point.y());
      lines += "\" z=\"";
      append_number(lines, point.z());
      lines += "\"/>\n";
    });
    xml_ += "</vertices>\n<triangles>\n";
    append_lines(xml_, range.end - range.first, [&](std::string& lines, std::size_t t) {
      append_triangle(lines, range.first + t, static_cast<std::uint32_t>(range.first_point));
    });
    xml_ += "</triangles>\n";
    if (has_groups()) append_groups(range);
    xml_ += "</mesh>\n</object>\n";
    return id;
  }

  // As sets of triangles.
  void append_groups(const MeshRange& range) {
    const std::vector<std::uint32_t>& of_triangle = attributes_->groups.of_triangle;
    std::vector<std::uint32_t> order;
    for (std::size_t t = range.first; t < range.end; ++t) {
      if (of_triangle[t] != kNone) order.push_back(static_cast<std::uint32_t>(t));
    }
    if (order.empty()) return;
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return of_triangle[a] < of_triangle[b];
    });
    xml_ += '<' + sets_ + ":trianglesets>\n";
    for (std::size_t i = 0; i < order.size();) {
      const std::uint32_t group = of_triangle[order[i]];
      xml_ += '<' + sets_ + ":triangleset";
      append_xml_attribute(xml_, "name", attributes_->groups.names[group]);
      append_xml_attribute(xml_, "identifier", "group" + std::to_string(group + 1));
      xml_ += ">\n";
      for (; i < order.size() && of_triangle[order[i]] == group; ++i) {
        const std::uint32_t first = order[i];
        const auto follows = [&] {
          return i + 1 < order.size() && order[i + 1] == order[i] + 1 &&
                 of_triangle[order[i + 1]] == group;
        };
        while (follows()) ++i;
        append_set_range(first - range.first, order[i] - range.first);
      }
      xml_ += "</" + sets_ + ":triangleset>\n";
    }
    xml_ += "</" + sets_ + ":trianglesets>\n";
  }

  void append_set_range(std::size_t first, std::size_t last) {
    xml_ += '<' + sets_ + (first == last ? ":ref" : ":refrange");
    append_xml_attribute(xml_, first == last ? "index" : "startindex", std::to_string(first));
    if (first != last) append_xml_attribute(xml_, "endindex", std::to_string(last));
    xml_ += "/>\n";
  }

  void append_triangle(std::string& lines, std::size_t t, std::uint32_t first_point) const {
    const auto append = [&](std::string_view before, std::uint32_t number) {
      lines += before;
      append_number(lines, number);
    };
    const IndexTriangle& corners = soup_.triangles[t];
    append("<triangle v1=\"", corners[0] - first_point);
    append("\" v2=\"", corners[1] - first_point);
    append("\" v3=\"", corners[2] - first_point);
    if (!properties_.of_triangle.empty() && properties_.of_triangle[t].group != kNone) {
      const auto& [group, index] = properties_.of_triangle[t];
      append("\" pid=\"", group);
      append("\" p1=\"", index[0]);
      if (index[1] != index[0] || index[2] != index[0]) {
        append("\" p2=\"", index[1]);
        append("\" p3=\"", index[2]);
      }
    }
    lines += '"';
    if (attributes_ != nullptr) append_paint(lines, t);
    lines += "/>\n";
  }

  void append_paint(std::string& lines, std::size_t t) const {
    for (const TrianglePaint& paint : attributes_->paints) {
      const std::uint32_t code = paint.codes.empty() ? kNone : paint.codes.of_triangle[t];
      if (code != kNone) append_xml_attribute(lines, paint.name, paint.codes.names[code]);
    }
  }

  const TriangleSoup& soup_;
  const SoupExtras& extras_;
  const Attributes* attributes_;
  const KeptPackage* kept_;
  std::string material_, production_, sets_;  // prefixes
  WrittenProperties properties_;
  std::unordered_map<std::string, std::string_view> declared_;  // spaces by their prefixes
  std::vector<const ModelMetadata*> metadata_;                  // of the model, objects and items
  std::vector<std::string> thumbnails_;
  std::vector<std::uint32_t> written_;  // ids of objects of the graph
  std::string xml_;
};

bool is_packed_already(std::string_view part) {
  const std::string extension = extension_of_part(part);
  return extension == "png" || extension == "jpg" || extension == "jpeg";
}

}  // namespace

std::string format_threemf(const TriangleSoup& soup, const SoupExtras& extras) {
  require_writable(soup);
  const auto* const kept =
      extras.attributes == nullptr
          ? nullptr
          : dynamic_cast<const KeptPackage*>(extras.attributes->keepsake.get());
  ModelWriter model(soup, extras, kept);
  PackageWriter package(kept, model.pictures());
  ZipWriter archive;
  archive.add_text(std::string(kContentTypesPart), package.content_types());
  archive.add_text(relationships_part_of(""), package.of_package());
  archive.add_text(std::string(kUsualModelPart), model.run());
  if (std::string links = package.of_model(model.thumbnails()); !links.empty()) {
    archive.add_text(relationships_part_of(kUsualModelPart), std::move(links));
  }
  for (const WrittenPicture& picture : model.pictures()) {
    archive.add(picture.name, *picture.bytes, true);
  }
  if (kept != nullptr) {
    for (const KeptPackage::Part& part : kept->parts) {
      const ProjectConfig* const config = model.config_of(part);
      if (config == nullptr) {
        archive.add(part.name, *part.bytes, is_packed_already(part.name));
      } else if (auto text = model.text_of(*config)) {
        archive.add_text(part.name, std::move(*text));
      }
    }
  }
  return archive.finish();
}

}  // namespace meshrepair
