// SPDX-License-Identifier: MIT
#include "kept_parts.h"

#include <algorithm>
#include <initializer_list>
#include <unordered_map>
#include <utility>

#include <base/error.h>

#include "common/model_values.h"
#include "formats/common/part_names.h"

namespace meshrepair {
namespace {

bool ends_with_one_of(std::string_view key, std::initializer_list<std::string_view> ends) {
  return std::any_of(ends.begin(), ends.end(),
                     [&](std::string_view end) { return key.ends_with(end); });
}

// What was made of the meshes as they were.
bool belongs_to_old_meshes(std::string_view key, std::string_view media_type) {
  if (key.starts_with("_xmlsignatures/") ||
      media_type.find("digital-signature") != std::string_view::npos ||
      media_type.find("3dmanufacturing-keystore") != std::string_view::npos) {
    return true;
  }
  if (!key.starts_with("metadata/")) return false;
  if (key.starts_with("metadata/plate_") && key.ends_with(".json")) return true;
  return ends_with_one_of(key, {"/slice_info.config", ".gcode", ".gcode.md5"});
}

// What is known of objects by their ids, or by their order. Without it programs take the mesh as
// one new object, and the settings of the print stay.
bool belongs_to_objects(std::string_view key) {
  if (is_project_config(key)) return true;
  return key.starts_with("metadata/") &&
         ends_with_one_of(
             key, {"cut_information.xml", "layer_heights_profile.txt", "layer_config_ranges.xml",
                   "layer_config_ranges.txt", "sla_support_points.txt", "sla_drain_holes.txt",
                   "brim_ear_points.txt"});
}

class PartKeeper {
 public:
  PartKeeper(const MeshSource& source, ZipReader& archive, const ContentTypes& types,
             KeptPackage& kept)
      : source_(source), archive_(archive), types_(types), kept_(kept) {}

  void run(const std::string& model, const std::unordered_set<std::string>& taken,
           ReadReport& report) {
    for (const ZipReader::Entry& entry : archive_.entries()) {
      const std::string key = part_key(entry.name);
      const std::string extension = extension_of_part(entry.name);
      if (key == part_key(kContentTypesPart) || extension == "rels" || extension == "model" ||
          taken.contains(key)) {
        continue;
      }
      keep(entry, key);
    }
    keep_relationships("", kept_.of_package);
    keep_relationships(model, kept_.of_model);
    warn(report, old_, "that belong to the meshes as they were",
         "it belongs to the meshes as they were");
    warn(report, unreadable_, "that cannot be read", "it cannot be read");
  }

 private:
  using Names = std::vector<std::string>;

  void keep(const ZipReader::Entry& entry, const std::string& key) {
    std::string media_type = types_.of(entry.name);
    if (belongs_to_old_meshes(key, media_type) || (belongs_to_objects(key) && !kept_.graph)) {
      old_.push_back(entry.name);
      return;
    }
    const auto is_it = [&](const KeptPackage::Config& one) { return one.name == entry.name; };
    if (is_project_config(key) && std::none_of(kept_.configs.begin(), kept_.configs.end(), is_it)) {
      return;  // it could not be read, and that is told
    }
    try {
      auto bytes = std::make_shared<const std::string>(archive_.text_of(entry));
      kept_.parts.push_back({entry.name, std::move(media_type), std::move(bytes)});
      keys_.insert(key);
    } catch (const InputError&) {
      unreadable_.push_back(entry.name);
    }
  }

  void keep_relationships(const std::string& part, std::vector<PackageRelationship>& to) {
    std::vector<PackageRelationship> all;
    try {
      all = read_relationships(source_, archive_, part);
    } catch (const InputError&) {
      unreadable_.push_back(relationships_part_of(part));
    }
    for (PackageRelationship& one : all) {
      if (keys_.contains(part_key(one.target))) to.push_back(std::move(one));
    }
  }

  // Who keeps the scene is told of each.
  void warn(ReadReport& report, const Names& names, const std::string& which,
            const std::string& why) const {
    constexpr std::size_t kMostNamed = 20;
    if (names.empty()) return;
    const std::string lost = " will not be written again";
    const auto tell = [&](const std::string& text, std::size_t parts) {
      report.warnings.push_back({WarningCode::package_parts_lost, text, {{"parts", parts}}});
    };
    const std::size_t named = kept_.graph ? std::min(names.size(), kMostNamed) : 0;
    const std::string lost_one = lost + ": " + why;
    for (std::size_t i = 0; i < named; ++i) tell(printable(names[i]) + lost_one, 1);
    if (names.size() == named) return;
    tell(counted(names.size() - named, named == 0 ? "part" : "more part") + " of the package " +
             which + lost + " (first: " + printable(names[named]) + ")",
         names.size() - named);
  }

  const MeshSource& source_;
  ZipReader& archive_;
  const ContentTypes& types_;
  KeptPackage& kept_;
  std::unordered_set<std::string> keys_;
  Names old_, unreadable_;
};

// Of parts of one package that come into another one.
class PartAppender {
 public:
  PartAppender(KeptPackage& all, const KeptPackage& other) : all_(all), other_(other) {
    for (const KeptPackage::Part& part : all_.parts) parts_.emplace(part_key(part.name), &part);
    for (const KeptPackage::Part& part : other_.parts) {
      others_.emplace(part_key(part.name), &part);
    }
  }

  void run() {
    append(other_.of_package, all_.of_package);
    append(other_.of_model, all_.of_model);
    all_.parts.insert(all_.parts.end(), fresh_.begin(), fresh_.end());
  }

 private:
  void append(const std::vector<PackageRelationship>& from, std::vector<PackageRelationship>& to) {
    for (PackageRelationship one : from) {
      const bool is_thumbnail = one.type.ends_with("/thumbnail");
      const bool has_one = std::any_of(to.begin(), to.end(), [&](const auto& known) {
        return is_thumbnail && known.type == one.type;
      });
      if (has_one) continue;
      one.target = name_in_all(part_key(one.target), one.target);
      const bool is_known = std::any_of(to.begin(), to.end(), [&](const auto& known) {
        return known.type == one.type && known.target == one.target;
      });
      if (!is_known) to.push_back(std::move(one));
    }
  }

  std::string name_in_all(const std::string& key, const std::string& target) {
    const auto [found, is_new] = names_.try_emplace(key, target);
    if (!is_new) return found->second;
    const auto part = others_.find(key);
    if (part == others_.end()) return target;
    found->second = part->second->name;
    for (int i = 2;; ++i) {
      const auto [same, is_free] = parts_.try_emplace(part_key(found->second), part->second);
      if (is_free) break;
      if (*same->second->bytes == *part->second->bytes) return found->second;
      found->second = numbered(part->second->name, i);
    }
    fresh_.push_back(*part->second);
    fresh_.back().name = found->second;
    return found->second;
  }

  // "a.png" as "a_2.png".
  static std::string numbered(const std::string& name, int number) {
    const std::size_t slash = name.rfind('/'), dot = name.rfind('.');
    const bool has_end =
        dot != std::string::npos && (slash == std::string::npos || dot > slash + 1);
    std::string result = has_end ? name.substr(0, dot) : name;
    result += '_';
    result += std::to_string(number);
    if (has_end) result += name.substr(dot);
    return result;
  }

  using Parts = std::unordered_map<std::string, const KeptPackage::Part*>;

  KeptPackage& all_;
  const KeptPackage& other_;
  Parts parts_, others_;                                // by part_key()
  std::unordered_map<std::string, std::string> names_;  // of parts of the other, by part_key()
  std::vector<KeptPackage::Part> fresh_;
};

}  // namespace

TextureSampling KeptPackage::Tiling::sampling() const { return read_sampling(u, v, filter); }

std::shared_ptr<const Keepsake> KeptPackage::appended_to(const Keepsake* first,
                                                         AppendedMaterials& /*materials*/) const {
  const auto* const before = dynamic_cast<const KeptPackage*>(first);
  if (before == nullptr) return nullptr;
  std::shared_ptr<KeptPackage> both = before->copy();
  PartAppender(*both, *this).run();
  both->tilings.insert(both->tilings.end(), tilings.begin(), tilings.end());
  return both;
}

std::shared_ptr<KeptPackage> KeptPackage::copy() const {
  auto result = std::make_shared<KeptPackage>();
  result->unit = unit;
  result->graph = graph;
  result->namespaces = namespaces;
  result->metadata = metadata;
  result->parts = parts;
  result->configs = configs;
  result->of_package = of_package;
  result->of_model = of_model;
  result->tilings = tilings;
  return result;
}

void keep_parts(const MeshSource& source, ZipReader& archive, const ContentTypes& types,
                const std::string& model, const std::unordered_set<std::string>& taken,
                KeptPackage& kept, ReadReport& report) {
  PartKeeper(source, archive, types, kept).run(model, taken, report);
}

std::vector<std::string> KeptPackage::lost_in(SoupFormat format) const {
  std::vector<std::string> lost;
  if (format == SoupFormat::threemf) return lost;
  const auto has_metadata = [](const auto& one) {
    return one.marks && !one.marks->metadata.empty();
  };
  const bool has_some =
      graph && (std::any_of(graph->objects.begin(), graph->objects.end(), has_metadata) ||
                std::any_of(graph->items.begin(), graph->items.end(), has_metadata));
  const auto is_not_printed = [](const KeptReference& one) {
    return one.marks && (one.marks->printable == "0" || one.marks->printable == "false");
  };
  if (!metadata.empty() || has_some) lost.emplace_back("metadata");
  if (graph && std::any_of(graph->items.begin(), graph->items.end(), is_not_printed)) {
    lost.emplace_back("what is not to be printed");
  }
  if (!configs.empty()) lost.emplace_back("what slicers say of objects and volumes");
  if (parts.size() > configs.size()) lost.emplace_back("other parts of the package");
  return lost;
}

}  // namespace meshrepair
