// SPDX-License-Identifier: MIT
#include "model_reader.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include <mesh/edge_table.h>
#include <mesh/mesh_limits.h>

#include "common/model_values.h"
#include "formats/common/part_names.h"

namespace meshrepair {

enum class ModelReader::Element : std::uint8_t {
  none,  // outside of all
  ignored,
  model,
  metadata,
  metadatagroup,
  resources,
  build,
  item,
  object,
  mesh,
  vertices,
  vertex,
  triangles,
  triangle,
  trianglesets,
  triangleset,
  ref,
  refrange,
  components,
  component,
  basematerials,
  base,
  colorgroup,
  color,
  texture2d,
  texture2dgroup,
  tex2coord,
  multiproperties,
  multi,
  compositematerials,
  beamlattice,
  beams,
  beam,
  balls,
  ball,
  beamsets,
};

namespace {

using Element = ModelReader::Element;

constexpr std::string_view kCorePrefix = "http://schemas.microsoft.com/3dmanufacturing/core/";
constexpr std::string_view kMaterialPrefix =
    "http://schemas.microsoft.com/3dmanufacturing/material/";
constexpr std::string_view kProductionPrefix =
    "http://schemas.microsoft.com/3dmanufacturing/production/";
constexpr std::string_view kSetPrefix =
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/";
constexpr std::string_view kBeamPrefix =
    "http://schemas.microsoft.com/3dmanufacturing/beamlattice/";
constexpr std::string_view kPathAttribute =
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06|path";

constexpr std::string_view kUuidAttribute =
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06|UUID";

// Beyond these, layers of properties are passed over: there is one of each kind at most.
constexpr std::size_t kMostLayers = 8;

// Of elements that are told as unknown.
constexpr std::size_t kMostNames = 8;

struct KnownElement {
  Element parent;
  std::string_view name;
  Element element;
};

// The most frequent ones first.
constexpr std::array<KnownElement, 36> kElements = {{
    {Element::triangles, "triangle", Element::triangle},
    {Element::vertices, "vertex", Element::vertex},
    {Element::beams, "beam", Element::beam},
    {Element::balls, "ball", Element::ball},
    {Element::triangleset, "ref", Element::ref},
    {Element::triangleset, "refrange", Element::refrange},
    {Element::texture2dgroup, "tex2coord", Element::tex2coord},
    {Element::multiproperties, "multi", Element::multi},
    {Element::colorgroup, "color", Element::color},
    {Element::basematerials, "base", Element::base},
    {Element::components, "component", Element::component},
    {Element::build, "item", Element::item},
    {Element::none, "model", Element::model},
    {Element::model, "metadata", Element::metadata},
    {Element::object, "metadatagroup", Element::metadatagroup},
    {Element::item, "metadatagroup", Element::metadatagroup},
    {Element::metadatagroup, "metadata", Element::metadata},
    {Element::model, "resources", Element::resources},
    {Element::model, "build", Element::build},
    {Element::resources, "object", Element::object},
    {Element::resources, "basematerials", Element::basematerials},
    {Element::resources, "colorgroup", Element::colorgroup},
    {Element::resources, "texture2d", Element::texture2d},
    {Element::resources, "texture2dgroup", Element::texture2dgroup},
    {Element::resources, "multiproperties", Element::multiproperties},
    {Element::resources, "compositematerials", Element::compositematerials},
    {Element::object, "mesh", Element::mesh},
    {Element::object, "components", Element::components},
    {Element::mesh, "vertices", Element::vertices},
    {Element::mesh, "triangles", Element::triangles},
    {Element::mesh, "trianglesets", Element::trianglesets},
    {Element::mesh, "beamlattice", Element::beamlattice},
    {Element::beamlattice, "beams", Element::beams},
    {Element::beamlattice, "balls", Element::balls},
    {Element::beamlattice, "beamsets", Element::beamsets},
    {Element::trianglesets, "triangleset", Element::triangleset},
}};

// What stands in others is told in other ways, or no loss.
bool is_known_place(Element parent) {
  return parent != Element::none && parent != Element::ignored && parent != Element::metadata &&
         parent != Element::compositematerials && parent != Element::beamsets;
}

bool is_known_space(std::string_view space) {
  return space.empty() || space.starts_with(kCorePrefix) || space.starts_with(kMaterialPrefix) ||
         space.starts_with(kSetPrefix) || space.starts_with(kBeamPrefix);
}

std::uint32_t index_in(const XmlAttributes& attributes, std::string_view name) {
  const auto value = attributes.find(name);
  return value ? read_model_index(*value) : kNone;
}

// Empty if there is none, or what stands there is none.
std::string uuid_in(const XmlAttributes& attributes) {
  constexpr std::string_view kForm = "00000000-0000-0000-0000-000000000000";
  const std::string text = attributes.text(kUuidAttribute);
  const bool is_one =
      std::equal(text.begin(), text.end(), kForm.begin(), kForm.end(), [](char c, char form) {
        return form == '-'
                   ? c == '-'
                   : std::string_view("0123456789abcdefABCDEF").find(c) != std::string_view::npos;
      });
  return is_one ? text : std::string();
}

bool is_object_type(std::string_view type) {
  constexpr std::array<std::string_view, 5> kTypes = {"model", "solidsupport", "support", "surface",
                                                      "other"};
  return std::find(kTypes.begin(), kTypes.end(), type) != kTypes.end();
}

std::shared_ptr<const ModelMarks> shared(ModelMarks marks) {
  if (marks == ModelMarks()) return nullptr;
  return std::make_shared<const ModelMarks>(std::move(marks));
}

// Settings of an object, as Cura has them.
VolumeRole role_of_settings(const std::vector<ModelMetadata>& settings) {
  constexpr std::string_view kCuraSpace = "http://software.ultimaker.com/xml/cura/3mf/";
  constexpr std::array<std::pair<std::string_view, VolumeRole>, 4> kRoles = {{
      {"support_mesh", VolumeRole::support},
      {"anti_overhang_mesh", VolumeRole::support_blocker},
      {"infill_mesh", VolumeRole::modifier},
      {"cutting_mesh", VolumeRole::modifier},
  }};
  for (const ModelMetadata& one : settings) {
    if (!one.space.starts_with(kCuraSpace) || in_lower_case(one.value) != "true") continue;
    const std::string_view key = std::string_view(one.name).substr(one.name.find(':') + 1);
    const auto* const role = std::find_if(kRoles.begin(), kRoles.end(),
                                          [&](const auto& known) { return known.first == key; });
    if (role != kRoles.end()) return role->second;
  }
  return VolumeRole::model;
}

bool is_truth(std::string_view word) {
  return word == "0" || word == "1" || word == "false" || word == "true";
}

// The first set that each triangle is in, or kNone; empty where there are no sets. Each triangle is
// looked at once, however many ranges it is in.
std::vector<std::uint32_t> sets_of_triangles(const std::vector<TriangleSet>& sets,
                                             std::size_t triangles) {
  if (sets.empty()) return {};
  std::vector<std::uint32_t> set_of(triangles, kNone);
  std::vector<std::uint32_t> next(triangles + 1);  // that is in none yet, or one on the way to it
  std::iota(next.begin(), next.end(), 0);
  const auto next_free = [&](std::uint32_t t) {
    while (next[t] != t) t = next[t] = next[next[t]];
    return t;
  };
  for (std::size_t s = 0; s < sets.size(); ++s) {
    for (const auto& [first, last] : sets[s].ranges) {
      if (first >= triangles) continue;
      for (std::uint32_t t = next_free(first); t <= last && t < triangles; t = next_free(t)) {
        set_of[t] = static_cast<std::uint32_t>(s);
        next[t] = t + 1;
      }
    }
  }
  return set_of;
}

}  // namespace

ModelReader::ModelReader(ModelPart& part, ModelOddities& oddities, std::uint32_t number,
                         PartNumber number_of, bool properties, std::size_t beam_sides)
    : part_(part),
      oddities_(oddities),
      number_(number),
      number_of_(std::move(number_of)),
      properties_(properties),
      beam_sides_(beam_sides) {}

void ModelReader::declare(std::string_view prefix, std::string_view space) {
  part_.namespaces.push_back({std::string(prefix), std::string(space)});
}

void ModelReader::start(std::string_view space, std::string_view name,
                        const XmlAttributes& attributes) {
  const Element parent = open_.empty() ? Element::none : open_.back();
  Element element = Element::ignored;
  if (is_known_space(space)) {
    const auto* const known =
        std::find_if(kElements.begin(), kElements.end(), [&](const KnownElement& candidate) {
          return candidate.parent == parent && candidate.name == name;
        });
    if (known != kElements.end()) element = known->element;
  }
  if (element == Element::ignored && is_known_place(parent) &&
      oddities_.unknown_elements.size() < kMostNames) {
    oddities_.unknown_elements.emplace(name);
  }
  open_.push_back(element);
  open(element, attributes);
}

void ModelReader::end() {
  if (open_.back() == Element::mesh) {
    end_mesh();
    end_lattice();
  }
  const bool is_group = open_.back() == Element::metadatagroup;
  open_.pop_back();
  if (is_group) end_group(open_.back() == Element::item);
}

void ModelReader::text(std::string_view piece) {
  if (open_.empty() || open_.back() != Element::metadata) return;
  if (properties_ || is_in_group()) metadata().back().value += piece;
}

void ModelReader::open(Element element, const XmlAttributes& attributes) {
  switch (element) {
    case Element::vertex:
      return read_vertex(attributes);
    case Element::triangle:
      return read_triangle(attributes);
    case Element::beam:
      return lattice_.beams.push_back(read_beam(attributes, lattice_));
    case Element::ball:
      return lattice_.balls.push_back(read_ball(attributes, lattice_));
    case Element::beamlattice:
      lattice_ = read_lattice(attributes);
      return;
    case Element::model:
      return read_model(attributes);
    case Element::object:
      return read_object(attributes);
    case Element::component:
      return read_reference(attributes, object().components);
    case Element::build:
      part_.build_uuid = uuid_in(attributes);
      return;
    case Element::item:
      return read_reference(attributes, part_.items);
    case Element::metadata:
      if (properties_ || is_in_group()) {
        metadata().push_back({attributes.text("name"),
                              {},
                              attributes.text("preserve"),
                              attributes.text("type"),
                              space_of_prefix(attributes.text("name"))});
      }
      return;
    default:
      if (properties_) open_property(element, attributes);
  }
}

bool ModelReader::is_in_group() const {
  return std::find(open_.begin(), open_.end(), Element::metadatagroup) != open_.end();
}

// Those of the model, or of the object or item that is open.
std::vector<ModelMetadata>& ModelReader::metadata() {
  return is_in_group() ? metadata_of_group_ : part_.metadata;
}

std::string ModelReader::space_of_prefix(std::string_view name) const {
  const std::size_t colon = name.find(':');
  if (colon == std::string_view::npos) return {};
  const auto known =
      std::find_if(part_.namespaces.begin(), part_.namespaces.end(),
                   [&](const ModelNamespace& one) { return one.prefix == name.substr(0, colon); });
  return known == part_.namespaces.end() ? std::string() : known->space;
}

void ModelReader::end_group(bool is_of_item) {
  std::vector<ModelMetadata> found = std::exchange(metadata_of_group_, {});
  if (found.empty()) return;
  if (!is_of_item && object().role == VolumeRole::model) object().role = role_of_settings(found);
  if (!properties_) return;
  auto& known = is_of_item ? part_.items.back().marks : object().marks;
  ModelMarks marks = known ? *known : ModelMarks();
  std::move(found.begin(), found.end(), std::back_inserter(marks.metadata));
  known = shared(std::move(marks));
}

void ModelReader::open_property(Element element, const XmlAttributes& attributes) {
  using GroupKind = PropertyGroup::Kind;
  switch (element) {
    case Element::basematerials:
      return add_group(GroupKind::base, attributes);
    case Element::base:
      group().names.push_back(attributes.text("name"));
      return add_colour(attributes.text("displaycolor"));
    case Element::colorgroup:
      return add_group(GroupKind::colour, attributes);
    case Element::color:
      return add_colour(attributes.text("color"));
    case Element::texture2d:
      part_.textures.push_back({index_in(attributes, "id"), attributes.text("path"),
                                attributes.text("contenttype"), attributes.text("tilestyleu"),
                                attributes.text("tilestylev"), attributes.text("filter")});
      return;
    case Element::texture2dgroup:
      add_group(GroupKind::texture, attributes);
      group().texture = index_in(attributes, "texid");
      return;
    case Element::tex2coord: {
      std::array<double, 2> point = {0, 0};
      (void)read_model_number(attributes.find("u").value_or(""), point[0]);
      (void)read_model_number(attributes.find("v").value_or(""), point[1]);
      group().points.push_back(point);
      return;
    }
    case Element::multiproperties:
      add_group(GroupKind::multi, attributes);
      return read_layers(attributes);
    case Element::multi:
      return read_layer_entries(attributes);
    case Element::triangleset:
      object().sets.push_back({attributes.text("name"), {}});
      return;
    case Element::ref:
      return add_range(index_in(attributes, "index"), index_in(attributes, "index"));
    case Element::refrange:
      return add_range(index_in(attributes, "startindex"), index_in(attributes, "endindex"));
    case Element::compositematerials:
      ++oddities_.unknown_groups;
      return add_group(GroupKind::unknown, attributes);
    default:
      return;
  }
}

void ModelReader::add_range(std::uint32_t first, std::uint32_t last) {
  if (first != kNone && last != kNone && first <= last) {
    object().sets.back().ranges.push_back({first, last});
  }
}

void ModelReader::read_model(const XmlAttributes& attributes) {
  saw_model_ = true;
  const std::string unit = attributes.text("unit");
  part_.unit = unit_named(unit);
  if (!part_.unit && !unit.empty()) {
    oddities_.unknown_unit = unit;
  }
  const std::string required = attributes.text("requiredextensions");
  std::string_view rest = required;
  while (true) {
    const std::string_view prefix = take_word(rest);
    if (prefix.empty()) return;
    const auto known = std::find_if(
        part_.namespaces.begin(), part_.namespaces.end(), [&](const ModelNamespace& candidate) {
          return candidate.prefix == prefix && (is_known_space(candidate.space) ||
                                                candidate.space.starts_with(kProductionPrefix));
        });
    if (known == part_.namespaces.end()) oddities_.unknown_extensions.emplace_back(prefix);
  }
}

void ModelReader::read_object(const XmlAttributes& attributes) {
  part_.objects.emplace_back();
  ModelObject& fresh = object();
  fresh.id = index_in(attributes, "id");
  fresh.name = attributes.text("name");
  const std::string type = attributes.text("type");
  if (type == "support" || type == "solidsupport") fresh.role = VolumeRole::support;
  if (type == "other") fresh.role = VolumeRole::other;
  ModelMarks marks{.part_number = attributes.text("partnumber"), .uuid = uuid_in(attributes)};
  if (is_object_type(type)) marks.type = type;
  if (const auto path = attributes.find("thumbnail"))
    marks.thumbnail = part_name(*path, part_.name);
  fresh.marks = shared(std::move(marks));
  fresh.property.group = index_in(attributes, "pid");
  fresh.property.index.fill(index_in(attributes, "pindex"));
  const auto number = static_cast<std::uint32_t>(part_.objects.size() - 1);
  if (!part_.object_of_id.try_emplace(fresh.id, number).second) ++oddities_.doubled_ids;
}

void ModelReader::read_vertex(const XmlAttributes& attributes) {
  Vec3d point = Vec3d::Constant(std::numeric_limits<double>::quiet_NaN());
  int good = 0;
  attributes.visit([&](std::string_view name, std::string_view value) {
    if (name.size() != 1 || name[0] < 'x' || name[0] > 'z') return;
    if (read_model_number(value, point[name[0] - 'x'])) ++good;
  });
  if (good != 3) ++oddities_.bad_points;
  object().mesh.points.push_back(point);
}

void ModelReader::read_triangle(const XmlAttributes& attributes) {
  IndexTriangle triangle = {kNone, kNone, kNone};
  PropertyUse property;
  bool is_painted = false;
  attributes.visit([&](std::string_view name, std::string_view value) {
    if (name == "pid") property.group = read_model_index(value);
    if (name.size() > 3 && !add_paint(name, value, property)) is_painted = true;
    if (name.size() != 2 || name[1] < '1' || name[1] > '3') return;
    const auto corner = static_cast<std::size_t>(name[1] - '1');
    if (name[0] == 'v') triangle[corner] = read_model_index(value);
    if (name[0] == 'p') property.index[corner] = read_model_index(value);
  });
  object().mesh.triangles.push_back(triangle);
  if (is_painted) ++oddities_.painted;
  if (properties_) object().properties.push_back(property);
}

// False if it is none that is known.
bool ModelReader::add_paint(std::string_view name, std::string_view value, PropertyUse& property) {
  const auto* const known =
      std::find_if(kPaintNames.begin(), kPaintNames.end(),
                   [&](const PaintName& candidate) { return candidate.read == name; });
  if (known == kPaintNames.end()) return false;
  if (!properties_ || value.empty()) return true;
  if (property.paint == kNone) {
    property.paint = static_cast<std::uint32_t>(part_.painted.size());
    part_.painted.emplace_back().fill(kNone);
  }
  const auto fresh = static_cast<std::uint32_t>(part_.codes.size());
  const auto [code, is_new] = number_of_code_.try_emplace(std::string(value), fresh);
  if (is_new) part_.codes.push_back(code->first);
  part_.painted.back()[static_cast<std::size_t>(known - kPaintNames.begin())] = code->second;
  return true;
}

// The points are known: triangles that name others are left out.
void ModelReader::end_mesh() {
  TriangleSoup& mesh = object().mesh;
  std::vector<PropertyUse>& properties = object().properties;
  std::vector<std::uint32_t> set_of = sets_of_triangles(object().sets, mesh.triangles.size());
  const std::size_t points = mesh.points.size();
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const IndexTriangle triangle = mesh.triangles[t];
    if (std::any_of(triangle.begin(), triangle.end(),
                    [&](std::uint32_t corner) { return corner >= points; })) {
      object().bad.push_back(static_cast<std::uint32_t>(t));
      continue;
    }
    mesh.triangles[kept] = triangle;
    if (properties_) properties[kept] = properties[t];
    if (!set_of.empty()) set_of[kept] = set_of[t];
    ++kept;
  }
  oddities_.bad_triangles += mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  if (properties_) properties.resize(kept);
  if (set_of.empty()) return;
  set_of.resize(kept);
  object().set_of_triangle = std::move(set_of);
}

// Its bodies are triangles of the mesh that say nothing.
void ModelReader::end_lattice() {
  if (lattice_.beams.empty() && lattice_.balls.empty()) return;
  const BeamLattice lattice = std::exchange(lattice_, {});
  TriangleSoup& mesh = object().mesh;
  require_triangles(mesh.triangles.size() + most_triangles_of(lattice, beam_sides_), part_.name);
  if (lattice.is_clipped) ++oddities_.clipped_lattices;
  oddities_.bad_beams += append_lattice(lattice, beam_sides_, mesh);
  if (properties_) object().properties.resize(mesh.triangles.size());
  if (!object().set_of_triangle.empty()) {
    object().set_of_triangle.resize(mesh.triangles.size(), kNone);
  }
}

void ModelReader::read_reference(const XmlAttributes& attributes,
                                 std::vector<ObjectReference>& references) {
  ObjectReference reference;
  reference.part = number_;
  reference.object = index_in(attributes, "objectid");
  if (const auto path = attributes.find(kPathAttribute)) reference.part = number_of_(*path);
  if (const auto text = attributes.find("transform")) {
    const auto placement = read_placement(*text);
    if (!placement) stream_->fail("a transform that is not twelve numbers");
    reference.placement = *placement;
  }
  ModelMarks marks{.part_number = attributes.text("partnumber"), .uuid = uuid_in(attributes)};
  if (const auto printable = attributes.find("printable"); printable && is_truth(*printable)) {
    marks.printable = *printable;
  }
  reference.marks = shared(std::move(marks));
  references.push_back(std::move(reference));
}

void ModelReader::add_group(PropertyGroup::Kind kind, const XmlAttributes& attributes) {
  part_.groups.emplace_back();
  group().kind = kind;
  group().id = index_in(attributes, "id");
}

void ModelReader::add_colour(std::string_view text) {
  const ModelColour colour = read_model_colour(text).value_or(ModelColour());
  group().colours.push_back(colour.values);
  group().has_opacity = group().has_opacity || colour.has_opacity;
}

void ModelReader::read_layers(const XmlAttributes& attributes) {
  const std::string ids = attributes.text("pids");
  std::string_view rest = ids;
  for (std::string_view id = take_word(rest); !id.empty(); id = take_word(rest)) {
    if (group().layers.size() == kMostLayers) {
      ++oddities_.unknown_groups;
      return;
    }
    group().layers.push_back(read_model_index(id));
  }
}

void ModelReader::read_layer_entries(const XmlAttributes& attributes) {
  const std::string entries = attributes.text("pindices");
  std::string_view rest = entries;
  for (std::size_t layer = 0; layer < group().layers.size(); ++layer) {
    const std::string_view entry = take_word(rest);
    group().layer_entries.push_back(entry.empty() ? 0 : read_model_index(entry));
  }
}

}  // namespace meshrepair
