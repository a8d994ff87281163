// SPDX-License-Identifier: MIT
#include "project_config.h"

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <utility>

#include "formats/common/part_names.h"
#include "formats/threemf/common/model_values.h"
#include "formats/threemf/common/xml_stream.h"

namespace meshrepair {
namespace {

using Spot = ProjectConfig::Spot;

// What PrusaSlicer and its descendants call them. All others are parts of the model, and what is
// unknown of them is kept to be told.
void set_role(std::string_view name, ProjectVolume& volume) {
  constexpr std::array<std::pair<std::string_view, VolumeRole>, 11> kNames = {{
      {"", VolumeRole::model},
      {"modelpart", VolumeRole::model},
      {"normal_part", VolumeRole::model},
      {"negativevolume", VolumeRole::negative},
      {"negative_part", VolumeRole::negative},
      {"parametermodifier", VolumeRole::modifier},
      {"modifier_part", VolumeRole::modifier},
      {"supportblocker", VolumeRole::support_blocker},
      {"support_blocker", VolumeRole::support_blocker},
      {"supportenforcer", VolumeRole::support_enforcer},
      {"support_enforcer", VolumeRole::support_enforcer},
  }};
  const std::string word = in_lower_case(name);
  const auto* const found = std::find_if(kNames.begin(), kNames.end(),
                                         [&](const auto& one) { return one.first == word; });
  volume.role = found == kNames.end() ? VolumeRole::model : found->second;
  volume.unknown_role = found == kNames.end() ? std::string(name) : std::string();
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// Where the value of an attribute stands in a tag.
std::optional<XmlStream::Span> find_value(std::string_view tag, std::string_view name) {
  std::size_t at = 0;
  const auto skip = [&](const auto& is_skipped) {
    while (at < tag.size() && is_skipped(tag[at])) ++at;
  };
  skip([](char c) { return !is_blank(c); });  // the name of the element
  while (at < tag.size()) {
    skip(is_blank);
    const std::size_t begin = at;
    skip([](char c) { return c != '=' && !is_blank(c); });
    const bool is_it = tag.substr(begin, at - begin) == name;
    skip([](char c) { return c == '=' || is_blank(c); });
    if (at >= tag.size()) break;
    const std::size_t end = tag.find(tag[at], at + 1);
    if (end == std::string_view::npos) break;
    if (is_it) return XmlStream::Span{at + 1, end - at - 1};
    at = end + 1;
  }
  return std::nullopt;
}

class ConfigReader final : public XmlHandler {
 public:
  ConfigReader(std::string_view text, std::vector<ProjectObject>& objects, std::vector<Spot>& spots)
      : text_(text), objects_(objects), spots_(spots) {}

  void attach(const XmlStream& stream) { stream_ = &stream; }

  void start(std::string_view /*space*/, std::string_view name,
             const XmlAttributes& attributes) override {
    const Element parent = open_.empty() ? Element::none : open_.back().element;
    const Element element = element_of(parent, name);
    open_.push_back({element, spots_.size()});
    switch (element) {
      case Element::object:
        return open_object(attributes);
      case Element::volume:
        return open_volume(attributes);
      case Element::instance:
        open_spot(Spot::Kind::instance);
        spots_.back().object = kNone;
        return refer(attributes, "object_id");
      case Element::metadata:
        return read_metadata(parent, attributes);
      case Element::mesh_stat:
        return mark(attributes, "face_count", Spot::Kind::volume_faces);
      default:
        return;
    }
  }

  void end() override {
    const Open open = open_.back();
    open_.pop_back();
    const bool has_spot = open.element == Element::object || open.element == Element::volume ||
                          open.element == Element::instance;
    if (!has_spot) return;
    Spot& spot = spots_[open.spot];
    spot.size = stream_->tag().end() - spot.at;
  }

  // To be called at the end: objects may stand behind what names them, or nothing else be said of
  // them.
  void resolve() {
    std::unordered_map<std::uint32_t, std::uint32_t> number_of;
    for (std::uint32_t i = 0; i < objects_.size(); ++i) number_of.try_emplace(objects_[i].id, i);
    for (const auto& [spot, id] : references_) {
      const auto fresh = static_cast<std::uint32_t>(objects_.size());
      const auto [found, is_new] = number_of.try_emplace(id, fresh);
      if (is_new) objects_.emplace_back().id = id;
      spots_[spot].object = found->second;
    }
  }

 private:
  enum class Element : std::uint8_t {
    none,
    config,
    object,
    volume,
    plate,
    assemble,
    instance,
    metadata,
    mesh_stat,
    ignored,
  };
  struct Open {
    Element element = Element::none;
    std::size_t spot = 0;  // its own, if it has one
  };

  static Element element_of(Element parent, std::string_view name) {
    struct Known {
      Element parent;
      std::string_view name;
      Element element;
    };
    constexpr std::array<Known, 13> kKnown = {{
        {Element::none, "config", Element::config},
        {Element::config, "object", Element::object},
        {Element::config, "plate", Element::plate},
        {Element::config, "assemble", Element::assemble},
        {Element::object, "volume", Element::volume},
        {Element::object, "part", Element::volume},
        {Element::object, "metadata", Element::metadata},
        {Element::volume, "metadata", Element::metadata},
        {Element::volume, "mesh_stat", Element::mesh_stat},
        {Element::plate, "metadata", Element::metadata},
        {Element::plate, "model_instance", Element::instance},
        {Element::instance, "metadata", Element::metadata},
        {Element::assemble, "assemble_item", Element::instance},
    }};
    const auto* const found = std::find_if(kKnown.begin(), kKnown.end(), [&](const Known& one) {
      return one.parent == parent && one.name == name;
    });
    return found == kKnown.end() ? Element::ignored : found->element;
  }

  void open_spot(Spot::Kind kind) {
    const auto object = static_cast<std::uint32_t>(objects_.empty() ? 0 : objects_.size() - 1);
    std::uint32_t volume = 0;
    if (!objects_.empty() && !objects_.back().volumes.empty()) {
      volume = static_cast<std::uint32_t>(objects_.back().volumes.size() - 1);
    }
    spots_.push_back({stream_->tag().at, 0, kind, object, volume});
  }

  // A value of the tag that is open, if it is there.
  void mark(const XmlAttributes& attributes, std::string_view name, Spot::Kind kind) {
    if (!attributes.find(name)) return;
    const XmlStream::Span tag = stream_->tag();
    const auto value = find_value(text_.substr(tag.at, tag.size), name);
    if (!value) stream_->fail("is in an encoding that cannot be read here");
    open_spot(kind);
    spots_.back().at = tag.at + value->at;
    spots_.back().size = value->size;
  }

  static std::uint32_t number(const XmlAttributes& attributes, std::string_view name) {
    return read_model_index(attributes.find(name).value_or(""));
  }

  void open_object(const XmlAttributes& attributes) {
    objects_.emplace_back();
    objects_.back().id = number(attributes, "id");
    open_spot(Spot::Kind::object);
    mark(attributes, "id", Spot::Kind::object_id);
  }

  void open_volume(const XmlAttributes& attributes) {
    ProjectVolume& volume = objects_.back().volumes.emplace_back();
    volume.part = number(attributes, "id");
    volume.first = number(attributes, "firstid");
    volume.last = number(attributes, "lastid");
    set_role(attributes.find("subtype").value_or(""), volume);
    const auto fresh = static_cast<std::uint32_t>(objects_.back().volumes.size() - 1);
    if (volume.part != kNone) objects_.back().volume_of_part.try_emplace(volume.part, fresh);
    open_spot(Spot::Kind::volume);
    mark(attributes, "id", Spot::Kind::part_id);
    mark(attributes, "firstid", Spot::Kind::first);
    mark(attributes, "lastid", Spot::Kind::last);
  }

  void read_metadata(Element parent, const XmlAttributes& attributes) {
    const std::string key = attributes.text("key"), value = attributes.text("value");
    if (parent == Element::plate) return read_file(attributes, value);
    if (parent == Element::instance) {
      if (key == "object_id") refer(attributes, "value");
      return;
    }
    ProjectObject& object = objects_.back();
    if (parent == Element::object) {
      if (key == "name") object.name = value;
      return mark(attributes, "face_count", Spot::Kind::object_faces);
    }
    ProjectVolume& volume = object.volumes.back();
    if (key == "name") volume.name = value;
    if (key == "modifier" && value == "1") volume.role = VolumeRole::modifier;
    if (key == "volume_type" || key == "part_type") set_role(value, volume);
  }

  // What slicing left: other parts of the package.
  void read_file(const XmlAttributes& attributes, const std::string& value) {
    if (!value.ends_with(".gcode") && !value.ends_with(".json")) return;
    mark(attributes, "value", Spot::Kind::file);
    spots_.back().value = value;
  }

  // The instance that is open, and a value in it, are of the object with this id.
  void refer(const XmlAttributes& attributes, std::string_view name) {
    if (!attributes.find(name)) return;
    const auto instance = std::find_if(open_.rbegin(), open_.rend(), [](const Open& one) {
      return one.element == Element::instance;
    });
    const std::uint32_t id = number(attributes, name);
    references_.emplace_back(instance->spot, id);
    mark(attributes, name, Spot::Kind::object_id);
    references_.emplace_back(spots_.size() - 1, id);
  }

  std::string_view text_;
  std::vector<ProjectObject>& objects_;
  std::vector<Spot>& spots_;
  const XmlStream* stream_ = nullptr;
  std::vector<Open> open_;
  std::vector<std::pair<std::size_t, std::uint32_t>> references_;  // spots, and ids of objects
};

}  // namespace

std::uint32_t ProjectObject::volume_of(std::size_t k, std::uint32_t mesh) const {
  if (k < volumes.size() && volumes[k].part == mesh) return static_cast<std::uint32_t>(k);
  const auto found = volume_of_part.find(mesh);
  return found == volume_of_part.end() ? kNone : found->second;
}

ProjectConfig::ProjectConfig(const MeshSource& source, const std::string& part,
                             std::shared_ptr<const std::string> bytes)
    : bytes_(std::move(bytes)) {
  ConfigReader reader(*bytes_, objects_, spots_);
  XmlStream stream(source, part, reader, XmlStream::Names::plain);
  reader.attach(stream);
  stream.feed(*bytes_);
  stream.finish();
  reader.resolve();
  // Attributes of one tag were looked for in an order of their own.
  std::stable_sort(spots_.begin(), spots_.end(),
                   [](const Spot& a, const Spot& b) { return a.at < b.at; });
}

std::size_t ProjectConfig::append_spot(const Spot& spot, const std::vector<WrittenObject>& now,
                                       bool is_part, std::string& text) const {
  using Kind = Spot::Kind;
  const WrittenObject none;
  const WrittenObject& object = spot.object < now.size() ? now[spot.object] : none;
  const bool has_volume = spot.volume < object.volumes.size();
  const WrittenVolume volume = has_volume ? object.volumes[spot.volume] : WrittenVolume();
  const auto as_it_was = [&] { text.append(*bytes_, spot.at, spot.size); };
  switch (spot.kind) {
    case Kind::object:
    case Kind::instance:
      return object.id == kNone ? spot.size : 0;
    case Kind::volume:
      return volume.is_there ? 0 : spot.size;
    case Kind::object_id:
      text += std::to_string(object.id);
      break;
    case Kind::part_id:
      if (volume.part == kNone) {
        as_it_was();
      } else {
        text += std::to_string(volume.part);
      }
      break;
    case Kind::first:
      text += std::to_string(volume.first);
      break;
    case Kind::last:
      text += std::to_string(volume.first + volume.triangles - 1);
      break;
    case Kind::object_faces:
      text += std::to_string(object.triangles);
      break;
    case Kind::volume_faces:
      text += std::to_string(volume.triangles);
      break;
    case Kind::file:
      if (is_part) as_it_was();
      break;
  }
  return spot.size;
}

bool is_project_config(std::string_view key) {
  return key.starts_with("metadata/") &&
         (key.ends_with("/model_settings.config") || key.ends_with("_model.config"));
}

}  // namespace meshrepair
