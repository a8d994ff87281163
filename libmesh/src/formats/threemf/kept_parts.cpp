#include "kept_parts.h"

#include <algorithm>
#include <array>
#include <utility>

#include <base/error.h>

#include "formats/common/part_names.h"

namespace meshrepair {
namespace {

// Programs find their own by these names. Without it they take the mesh as one new object, and the
// settings of the print stay.
bool belongs_to_old_meshes(std::string_view key, std::string_view media_type) {
  constexpr std::array<std::string_view, 12> kEnds = {"/model_settings.config",
                                                      "/slice_info.config",
                                                      "/slic3r_pe_model.config",
                                                      "cut_information.xml",
                                                      "layer_heights_profile.txt",
                                                      "layer_config_ranges.xml",
                                                      "layer_config_ranges.txt",
                                                      "sla_support_points.txt",
                                                      "sla_drain_holes.txt",
                                                      "brim_ear_points.txt",
                                                      ".gcode",
                                                      ".gcode.md5"};
  if (key.starts_with("_xmlsignatures/") ||
      media_type.find("digital-signature") != std::string_view::npos ||
      media_type.find("3dmanufacturing-keystore") != std::string_view::npos) {
    return true;
  }
  if (!key.starts_with("metadata/")) return false;
  if (key.starts_with("metadata/plate_") && key.ends_with(".json")) return true;
  return std::any_of(kEnds.begin(), kEnds.end(),
                     [&](std::string_view end) { return key.ends_with(end); });
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
    warn(report, old_, "that belong to the meshes as they were will not be written again");
    warn(report, unreadable_, "that cannot be read will not be written again");
  }

 private:
  using Names = std::vector<std::string>;

  void keep(const ZipReader::Entry& entry, const std::string& key) {
    std::string media_type = types_.of(entry.name);
    if (belongs_to_old_meshes(key, media_type)) {
      old_.push_back(entry.name);
      return;
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

  static void warn(ReadReport& report, const Names& names, const std::string& why) {
    if (names.empty()) return;
    report.warnings.push_back(counted(names.size(), "part") + " of the package " + why +
                              " (first: " + printable(names.front()) + ")");
  }

  const MeshSource& source_;
  ZipReader& archive_;
  const ContentTypes& types_;
  KeptPackage& kept_;
  std::unordered_set<std::string> keys_;
  Names old_, unreadable_;
};

}  // namespace

void keep_parts(const MeshSource& source, ZipReader& archive, const ContentTypes& types,
                const std::string& model, const std::unordered_set<std::string>& taken,
                KeptPackage& kept, ReadReport& report) {
  PartKeeper(source, archive, types, kept).run(model, taken, report);
}

std::vector<std::string> KeptPackage::lost_in(SoupFormat format) const {
  std::vector<std::string> lost;
  if (format == SoupFormat::threemf) return lost;
  if (!metadata.empty()) lost.emplace_back("metadata");
  if (!parts.empty()) lost.emplace_back("other parts of the package");
  return lost;
}

}  // namespace meshrepair
