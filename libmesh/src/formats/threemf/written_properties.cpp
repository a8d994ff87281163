// SPDX-License-Identifier: MIT
#include "written_properties.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <system_error>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <base/error.h>
#include <base/file_bytes.h>

#include "common/model_values.h"
#include "common/xml_text.h"
#include "formats/common/part_names.h"
#include "formats/common/text_writer.h"
#include "property_labels.h"
#include "threemf_io.h"

namespace meshrepair {
namespace {

// Pictures of the only types that the format has. Told by their bytes: nothing else that a file
// names as a picture gets into a package.
std::string_view picture_type(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\x89PNG\r\n\x1A\n"sv)) return "image/png";
  if (bytes.starts_with("\xFF\xD8\xFF"sv)) return "image/jpeg";
  return {};
}

std::shared_ptr<const std::string> bytes_of_picture(const Image& image) {
  std::error_code error;
  const bool is_file = is_regular_file(std::filesystem::symlink_status(image.path, error));
  if (image.bytes || image.is_elsewhere || !is_file) return image.bytes;
  try {
    return std::make_shared<const std::string>(FileBytes(image.path).bytes());
  } catch (const InputError&) {
    return nullptr;
  }
}

// A name of a material as the last word of a part's name.
std::string stem_of_part(std::string_view name) {
  constexpr std::size_t kLongest = 80;
  std::string stem(name.substr(0, kLongest));
  for (char& c : stem) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7F' || c == '/' || c == '\\' || c == ':') {
      c = '_';
    }
  }
  if (stem.empty() || stem == "." || stem == "..") return "texture";
  std::string encoded;
  for (const char c : stem) encoded += c == '%' ? "%25" : std::string(1, c);
  return percent_encoded(encoded);
}

void append_colour(std::string& xml, const double* values, std::size_t components) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  xml += '#';
  for (std::size_t i = 0; i < components; ++i) {
    const double share = values[i] >= 0 ? std::min(values[i], 1.0) : 0.0;
    const auto byte = static_cast<unsigned>(std::lround(255 * share));
    xml += kDigits[byte / 16];
    xml += kDigits[byte % 16];
  }
}

class PropertyWriter {
 public:
  PropertyWriter(const TriangleSoup& soup, const Attributes& attributes, const KeptPackage* kept,
                 const std::string& prefix, std::uint32_t first_id)
      : soup_(soup),
        attributes_(attributes),
        kept_(kept),
        prefix_(prefix),
        points_(find_kind(attributes, CornerAttribute::Kind::texture)),
        colours_(find_kind(attributes, CornerAttribute::Kind::colour)) {
    result_.next_id = first_id;
    if (kept != nullptr) {
      for (const KeptPackage::Part& part : kept->parts) used_names_.insert(part_key(part.name));
    }
    if (colours_ != nullptr && (colours_->components < 3 || colours_->components > 4)) {
      colours_ = nullptr;
    }
    if (points_ != nullptr && points_->components < 2) points_ = nullptr;
  }

  WrittenProperties run() {
    find_pictures();
    layers_.resize(soup_.triangles.size());
    for (std::size_t t = 0; t < layers_.size(); ++t) layers_[t] = layers_of(t);
    const auto is_empty = [](const Layers& layers) { return layers.empty(); };
    if (std::all_of(layers_.begin(), layers_.end(), is_empty)) return {};
    number_groups();
    result_.of_triangle.resize(layers_.size());
    for (std::size_t t = 0; t < layers_.size(); ++t) result_.of_triangle[t] = property_of(t);
    set_default();
    write_groups();
    return std::move(result_);
  }

 private:
  // What a triangle has.
  struct Layers {
    std::uint32_t base = kNone;     // a material without a picture of its own
    std::uint32_t picture = kNone;  // of textures_
    bool colours = false;

    [[nodiscard]] bool empty() const { return base == kNone && picture == kNone && !colours; }
    [[nodiscard]] int count() const {
      return static_cast<int>(base != kNone) + static_cast<int>(picture != kNone) +
             static_cast<int>(colours);
    }
  };
  struct Texture {
    std::uint32_t picture = kNone;  // of result_.pictures
    TextureSampling sampling;
  };
  // Entries of a texture2dgroup, in the order of their first use.
  struct PointList {
    std::uint32_t group = kNone;
    std::vector<std::uint32_t> points;
    std::unordered_map<std::uint32_t, std::uint32_t> number;
  };
  // Entries of a multiproperties group: of the base materials, the points and the colours.
  using Entry = std::array<std::uint32_t, 3>;
  struct Combinations {
    std::uint32_t group = kNone;
    bool has_base = false, has_colours = false;
    std::uint32_t picture = kNone;
    std::vector<Entry> entries;
    std::map<Entry, std::uint32_t> number;
  };

  // The first material that has a picture gives it its name; others that share it are base
  // materials below it.
  void find_pictures() {
    const auto& names = attributes_.materials.names;
    picture_of_.assign(names.size(), kNone);
    is_base_.assign(names.size(), 1);
    if (points_ == nullptr) return;
    std::unordered_map<std::uint32_t, std::uint32_t> of_image;  // parts
    for (std::size_t m = 0; m < std::min(names.size(), attributes_.looks.size()); ++m) {
      const Material& look = attributes_.looks[m];
      if (look.image >= attributes_.images.size()) continue;
      const auto [found, is_new] = of_image.try_emplace(look.image, kNone);
      if (is_new) found->second = add_picture(look.image, names[m]);
      if (found->second == kNone) continue;
      picture_of_[m] = texture_of(found->second, look.sampling);
      if (is_new) is_base_[m] = 0;
    }
  }

  std::uint32_t texture_of(std::uint32_t picture, const TextureSampling& sampling) {
    const auto known = std::find_if(textures_.begin(), textures_.end(), [&](const Texture& one) {
      return one.picture == picture && one.sampling == sampling;
    });
    const auto number = static_cast<std::uint32_t>(known - textures_.begin());
    if (known == textures_.end()) textures_.push_back({picture, sampling});
    return number;
  }

  std::uint32_t add_picture(std::uint32_t image, const std::string& material) {
    auto bytes = bytes_of_picture(attributes_.images[image]);
    const std::string_view type = bytes ? picture_type(*bytes) : std::string_view();
    if (type.empty()) return kNone;
    const std::string stem = stem_of_part(material);
    const std::string extension = type == "image/png" ? ".png" : ".jpg";
    std::string name;
    for (int i = 1; name.empty(); ++i) {
      const std::string number = i == 1 ? std::string() : "%20" + std::to_string(i);
      name = "3D/Textures/";
      name.append(stem).append(number).append(extension);
      if (!used_names_.insert(part_key(name)).second) name.clear();
    }
    result_.pictures.push_back({name, std::string(type), std::move(bytes), image});
    return static_cast<std::uint32_t>(result_.pictures.size() - 1);
  }

  [[nodiscard]] static bool is_full(const CornerAttribute* values, std::size_t t) {
    if (values == nullptr || values->of_corner.empty()) return false;
    const std::uint32_t* const of = values->of_corner.data() + 3 * t;
    return std::none_of(of, of + 3, [](std::uint32_t value) { return value == kNone; });
  }

  [[nodiscard]] Layers layers_of(std::size_t t) const {
    Layers layers;
    const auto& labels = attributes_.materials;
    const std::uint32_t material = labels.empty() ? kNone : labels.of_triangle[t];
    if (material != kNone) {
      if (is_full(points_, t)) layers.picture = picture_of_[material];
      if (layers.picture == kNone || is_base_[material] != 0) layers.base = material;
    }
    layers.colours = is_full(colours_, t);
    return layers;
  }

  void number_groups() {
    for (const Layers& layers : layers_) {
      has_base_ = has_base_ || layers.base != kNone;
      has_colours_ = has_colours_ || layers.colours;
      has_nothing_ = has_nothing_ || layers.empty();
    }
    // Triangles without properties need an entry as soon as others have one; and the names and
    // colours of materials with pictures stand nowhere else.
    if (has_base_ || has_nothing_ || !result_.pictures.empty()) base_group_ = result_.next_id++;
    if (has_colours_) colour_group_ = result_.next_id++;
    points_of_.resize(textures_.size());
    for (PointList& list : points_of_) {
      result_.next_id++;  // of the texture
      list.group = result_.next_id++;
    }
  }

  WrittenProperties::OfTriangle property_of(std::size_t t) {
    const Layers& layers = layers_[t];
    WrittenProperties::OfTriangle property;
    if (layers.empty()) return property;
    for (std::size_t k = 0; k < 3; ++k) {
      Entry entry = {kNone, kNone, kNone};
      if (layers.base != kNone) entry[0] = layers.base;
      if (layers.picture != kNone) entry[1] = point_entry(layers.picture, 3 * t + k);
      if (layers.colours) entry[2] = colours_->of_corner[3 * t + k];
      if (layers.count() > 1) {
        property.index[k] = combined_entry(layers, entry, property.group);
      } else {
        property.index[k] = std::min({entry[0], entry[1], entry[2]});
      }
    }
    if (layers.count() > 1) return property;
    property.group = layers.base != kNone ? base_group_
                     : layers.colours     ? colour_group_
                                          : points_of_[layers.picture].group;
    return property;
  }

  std::uint32_t point_entry(std::uint32_t picture, std::size_t corner) {
    PointList& list = points_of_[picture];
    const std::uint32_t point = points_->of_corner[corner];
    const auto fresh = static_cast<std::uint32_t>(list.points.size());
    const auto [found, is_new] = list.number.try_emplace(point, fresh);
    if (is_new) list.points.push_back(point);
    return found->second;
  }

  std::uint32_t combined_entry(const Layers& layers, const Entry& entry, std::uint32_t& group) {
    const auto key = std::tuple(layers.base != kNone, layers.picture, layers.colours);
    const auto [found, is_new] = combinations_.try_emplace(key);
    Combinations& list = found->second;
    if (is_new) {
      list.group = result_.next_id++;
      list.has_base = layers.base != kNone;
      list.has_colours = layers.colours;
      list.picture = layers.picture;
    }
    group = list.group;
    const auto fresh = static_cast<std::uint32_t>(list.entries.size());
    const auto [entry_found, is_new_entry] = list.number.try_emplace(entry, fresh);
    if (is_new_entry) list.entries.push_back(entry);
    return entry_found->second;
  }

  void set_default() {
    const auto last = static_cast<std::uint32_t>(attributes_.materials.names.size());
    result_.of_object = result_.of_triangle.front();
    if (has_nothing_) result_.of_object = {base_group_, {last, last, last}};
  }

  void write_groups() {
    if (base_group_ != kNone) write_base_materials();
    if (has_colours_) write_colours();
    for (std::size_t i = 0; i < points_of_.size(); ++i) write_texture(i);
    // In the order of their numbers.
    std::vector<const Combinations*> lists;
    for (const auto& [key, list] : combinations_) lists.push_back(&list);
    std::sort(lists.begin(), lists.end(),
              [](const auto* a, const auto* b) { return a->group < b->group; });
    for (const Combinations* const list : lists) write_combinations(*list);
  }

  void open_group(std::string_view element, std::uint32_t id) {
    result_.resources += "<";
    result_.resources += element;
    append_xml_attribute(result_.resources, "id", std::to_string(id));
  }

  // Also those with a picture, in case that a triangle has no coordinates in it.
  void write_base_materials() {
    std::string& xml = result_.resources;
    open_group("basematerials", base_group_);
    xml += ">\n";
    const auto& names = attributes_.materials.names;
    for (std::size_t m = 0; m < names.size(); ++m) {
      const Material look = m < attributes_.looks.size() ? attributes_.looks[m] : Material();
      write_base(names[m], look);
    }
    if (has_nothing_) write_base(kNoMaterialName, Material());
    xml += "</basematerials>\n";
  }

  void write_base(std::string_view name, const Material& look) {
    std::string& xml = result_.resources;
    xml += "<base";
    append_xml_attribute(xml, "name", name);
    xml += " displaycolor=\"";
    append_colour(xml, look.colour.data(), 4);
    xml += "\"/>\n";
  }

  void write_colours() {
    std::string& xml = result_.resources;
    open_group(prefix_ + "colorgroup", colour_group_);
    xml += ">\n";
    append_lines(xml, colours_->count(), [&](std::string& lines, std::size_t i) {
      lines += "<" + prefix_ + "color color=\"";
      append_colour(lines, colours_->values.data() + colours_->components * i,
                    colours_->components);
      lines += "\"/>\n";
    });
    xml += "</" + prefix_ + "colorgroup>\n";
  }

  void write_texture(std::size_t number) {
    const PointList& list = points_of_[number];
    const Texture& texture = textures_[number];
    const WrittenPicture& picture = result_.pictures[texture.picture];
    std::string& xml = result_.resources;
    open_group(prefix_ + "texture2d", list.group - 1);
    append_xml_attribute(xml, "path", "/" + picture.name);
    append_xml_attribute(xml, "contenttype", picture.media_type);
    write_tiling(*picture.bytes, texture.sampling);
    xml += "/>\n";
    open_group(prefix_ + "texture2dgroup", list.group);
    append_xml_attribute(xml, "texid", std::to_string(list.group - 1));
    xml += ">\n";
    append_lines(xml, list.points.size(), [&](std::string& lines, std::size_t i) {
      const double* const point =
          points_->values.data() + points_->components * std::size_t{list.points[i]};
      lines += "<" + prefix_ + "tex2coord u=\"";
      append_number(lines, std::isfinite(point[0]) ? point[0] : 0.0);
      lines += "\" v=\"";
      append_number(lines, std::isfinite(point[1]) ? point[1] : 0.0);
      lines += "\"/>\n";
    });
    xml += "</" + prefix_ + "texture2dgroup>\n";
  }

  // What is so by default stands there only if it stood there before.
  void write_tiling(const std::string& picture, const TextureSampling& sampling) {
    KeptPackage::Tiling words;
    if (kept_ != nullptr) {
      const auto& kept = kept_->tilings;
      const auto same = std::find_if(kept.begin(), kept.end(), [&](const auto& one) {
        return one.picture.get() == &picture && one.sampling() == sampling;
      });
      if (same != kept.end()) words = *same;
    }
    if (words.sampling() != sampling) {
      const auto name = [](TextureSampling::Wrap wrap) {
        return std::string(wrap == TextureSampling::Wrap::repeat ? "" : tile_name(wrap));
      };
      words.u = name(sampling.wrap[0]);
      words.v = name(sampling.wrap[1]);
      const bool has_filter = sampling.filter != TextureSampling::Filter::automatic;
      words.filter = has_filter ? filter_name(sampling.filter) : "";
    }
    std::string& xml = result_.resources;
    if (!words.u.empty()) append_xml_attribute(xml, "tilestyleu", words.u);
    if (!words.v.empty()) append_xml_attribute(xml, "tilestylev", words.v);
    if (!words.filter.empty()) append_xml_attribute(xml, "filter", words.filter);
  }

  void write_combinations(const Combinations& list) {
    std::string& xml = result_.resources;
    const bool has_picture = list.picture != kNone;
    std::string groups, blends;
    if (list.has_base) groups += std::to_string(base_group_);
    if (has_picture) {
      if (list.has_base) blends = "mix";
      groups += " " + std::to_string(points_of_[list.picture].group);
    }
    if (list.has_colours) {
      if (has_picture) blends += " multiply";
      groups += " " + std::to_string(colour_group_);
    }
    const auto trimmed_list = [](const std::string& words) {
      return words.starts_with(' ') ? words.substr(1) : words;
    };
    open_group(prefix_ + "multiproperties", list.group);
    append_xml_attribute(xml, "pids", trimmed_list(groups));
    if (!blends.empty()) append_xml_attribute(xml, "blendmethods", trimmed_list(blends));
    xml += ">\n";
    append_lines(xml, list.entries.size(), [&](std::string& lines, std::size_t i) {
      lines += "<" + prefix_ + "multi pindices=\"";
      bool first = true;
      for (const std::uint32_t index : list.entries[i]) {
        if (index == kNone) continue;
        if (!first) lines += ' ';
        first = false;
        append_number(lines, index);
      }
      lines += "\"/>\n";
    });
    xml += "</" + prefix_ + "multiproperties>\n";
  }

  const TriangleSoup& soup_;
  const Attributes& attributes_;
  const KeptPackage* kept_;
  std::string prefix_;
  const CornerAttribute* points_;
  const CornerAttribute* colours_;
  std::unordered_set<std::string> used_names_;
  std::vector<std::uint32_t> picture_of_;  // of the materials
  std::vector<char> is_base_;              // of the materials: also where they have a picture
  std::vector<Layers> layers_;             // of the triangles
  bool has_base_ = false, has_colours_ = false, has_nothing_ = false;
  std::uint32_t base_group_ = kNone, colour_group_ = kNone;
  std::vector<Texture> textures_;
  std::vector<PointList> points_of_;  // of the textures
  std::map<std::tuple<bool, std::uint32_t, bool>, Combinations> combinations_;
  WrittenProperties result_;
};

}  // namespace

bool can_be_in_threemf(const Image& image) {
  const auto bytes = bytes_of_picture(image);
  return bytes != nullptr && !picture_type(*bytes).empty();
}

WrittenProperties write_properties(const TriangleSoup& soup, const Attributes& attributes,
                                   const KeptPackage* kept, const std::string& material,
                                   std::uint32_t first_id) {
  return PropertyWriter(soup, attributes, kept, material + ":", first_id).run();
}

}  // namespace meshrepair
