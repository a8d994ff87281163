// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <base/error.h>

#include "common/xml_stream.h"
#include "filament_colours.h"
#include "formats/common/part_names.h"
#include "formats/common/zip_reader.h"
#include "kept_parts.h"
#include "model_instances.h"
#include "model_reader.h"
#include "package_parts.h"
#include "project/project_config.h"
#include "property_labels.h"
#include "threemf_io.h"
#include "volume_ranges.h"

namespace meshrepair {
namespace {

class ThreemfReader {
 public:
  explicit ThreemfReader(const MeshSource& source) : source_(source), archive_(source) {}

  ReadResult run() {
    result_.report.format = SoupFormat::threemf;
    if (archive_.passed_over() > 0) {
      warn(WarningCode::content_ignored,
           counted(archive_.passed_over(), "part") +
               " ignored: names that lead out of the package, or duplicate names");
    }
    read_parts(find_start());
    read_projects();
    InstanceResult placed = place_instances(source_, parts_);
    report_oddities(placed);
    tell_volumes(placed);
    if (source_.options.attributes || source_.options.by_mesh) keep_rest(placed);
    result_.scene = std::move(placed.scene);
    result_.soup = std::move(placed.soup);
    result_.placed = std::move(placed.placed);
    result_.report.unit = parts_.front().unit.value_or(LengthUnit::millimeter);
    return std::move(result_);
  }

 private:
  void warn(WarningCode code, std::string text) {
    result_.report.warnings.push_back({code, std::move(text)});
  }

  const ZipReader::Entry& find_start() {
    std::vector<std::string> targets;
    try {
      for (const PackageRelationship& one : read_relationships(source_, archive_, "")) {
        if (one.type == kModelRelationship) targets.push_back(one.target);
      }
    } catch (const InputError&) {
      warn(WarningCode::start_unclear, "the relationships of the package cannot be read");
    }
    if (targets.size() > 1)
      warn(WarningCode::start_unclear, "the package names several first models: the first is read");
    for (const std::string& target : targets) {
      if (const ZipReader::Entry* const entry = archive_.find(target)) return *entry;
    }
    warn(WarningCode::start_unclear, "the package does not say which part is its model");
    if (const ZipReader::Entry* const usual = archive_.find(kUsualModelPart)) return *usual;
    const auto& entries = archive_.entries();
    const auto any = std::find_if(entries.begin(), entries.end(), [](const auto& entry) {
      return extension_of_part(entry.name) == "model";
    });
    if (any == entries.end()) source_.fail("is a ZIP archive without a 3D model");
    return *any;
  }

  // The first one, and those that are named by what was read.
  void read_parts(const ZipReader::Entry& start) {
    (void)number_of(start.name);
    for (std::size_t i = 0; i < names_.size(); ++i) {
      parts_.emplace_back();
      parts_.back().name = names_[i];
      const ZipReader::Entry* const entry = archive_.find(names_[i]);
      if (entry == nullptr) {
        ++missing_parts_;
        continue;
      }
      read_part(*entry, static_cast<std::uint32_t>(i));
    }
  }

  std::uint32_t number_of(const std::string& name) {
    const auto fresh = static_cast<std::uint32_t>(names_.size());
    const auto [found, is_new] = number_of_part_.try_emplace(part_key(name), fresh);
    if (is_new) names_.push_back(name);
    return found->second;
  }

  void read_part(const ZipReader::Entry& entry, std::uint32_t number) {
    const auto number_of_path = [&](std::string_view path) {
      return number_of(part_name(path, entry.name));
    };
    ModelReader reader(parts_.back(), oddities_, number, number_of_path, source_.options.attributes,
                       source_.options.beam_sides);
    XmlStream stream(source_, entry.name, reader);
    reader.attach(stream);
    std::uint64_t read = 0;
    archive_.read(entry, [&](std::string_view piece) {
      read += piece.size();
      tell_progress(entry, read);
      stream.feed(piece);
    });
    stream.finish();
    if (!reader.saw_model()) source_.fail("its part " + printable(entry.name) + " is no 3D model");
    packed_ += entry.packed;
  }

  // What slicers say of the objects of the first part.
  void read_projects() {
    for (const ZipReader::Entry& entry : archive_.entries()) {
      if (!is_project_config(part_key(entry.name))) continue;
      try {
        auto bytes = std::make_shared<const std::string>(archive_.text_of(entry));
        auto config = std::make_shared<ProjectConfig>(source_, entry.name, std::move(bytes));
        for (const ProjectObject& object : config->objects()) apply(object);
        configs_.push_back({entry.name, std::move(config)});
      } catch (const InputError&) {
        warn(WarningCode::project_unreadable,
             "what " + printable(entry.name) + " says of objects and volumes cannot be read");
      }
    }
  }

  void apply(const ProjectObject& said) {
    ModelPart& part = parts_.front();
    const auto number = part.object_of_id.find(said.id);
    if (number == part.object_of_id.end()) {
      return warn(WarningCode::project_unreadable,
                  "the project speaks of the object " +
                      (said.name.empty() ? std::to_string(said.id) : printable(said.name)) +
                      ", which is not there: what it says is not used");
    }
    for (const ProjectVolume& volume : said.volumes) {
      if (volume.unknown_role.empty()) continue;
      warn(WarningCode::project_unreadable, "the volume " + printable(volume.name) + " is a " +
                                                printable(volume.unknown_role) +
                                                ", which is unknown: taken for model");
    }
    if (part.objects[number->second].project != nullptr) return;
    part.objects[number->second].project = &said;
    if (part.objects[number->second].components.empty()) {
      split_volumes(part, number->second, said, oddities_);
    }
  }

  void tell_progress(const ZipReader::Entry& entry, std::uint64_t read) {
    ProgressObserver* const progress = source_.options.progress;
    if (progress == nullptr) return;
    const double of_part = static_cast<double>(read) / static_cast<double>(entry.size);
    const double bytes = static_cast<double>(packed_) + of_part * static_cast<double>(entry.packed);
    share_ = std::clamp(bytes / static_cast<double>(source_.bytes.size()), share_, 1.0);
    progress->advance(share_);
    if (progress->cancelled()) throw Cancelled();
  }

  void report_oddities(const InstanceResult& placed) {
    const std::string left_out = " left out: ";
    ReadReport& report = result_.report;
    report.bad_faces = oddities_.bad_triangles;
    report.bad_points = oddities_.bad_points;
    warn_if(WarningCode::faces_unreadable, oddities_.bad_triangles, "triangle",
            left_out + "they name points that do not exist");
    warn_if(WarningCode::points_unreadable, oddities_.bad_points, "point",
            " with coordinates that are missing or not numbers");
    warn_if(WarningCode::references_missing, oddities_.doubled_ids, "object",
            " passed over: no number of their own");
    warn_if(WarningCode::references_missing, missing_parts_, "part", " with objects missing");
    warn_if(WarningCode::references_missing, placed.missing, "reference",
            " to objects that are not there");
    warn_if(WarningCode::references_missing, oddities_.bad_ranges, "volume",
            " taken for model: their triangles are not there, or those of others");
    warn_if(WarningCode::faces_unreadable, oddities_.bad_beams, "beam",
            left_out + "of points that do not exist, or without a size; balls among them");
    warn_if(WarningCode::extension_unknown, oddities_.clipped_lattices, "beam lattice",
            " not cut by the mesh that clips it");
    if (!oddities_.unknown_unit.empty()) {
      warn(WarningCode::unit_unknown, "the unit " + printable(oddities_.unknown_unit) +
                                          " is not known: taken for millimeters");
    }
    if (!oddities_.unknown_elements.empty()) {
      std::string names;
      for (const std::string& name : oddities_.unknown_elements) {
        names += (names.empty() ? "" : ", ") + printable(name);
      }
      warn(WarningCode::content_ignored, "what is not known here is left out: " + names);
    }
    for (const std::string& extension : oddities_.unknown_extensions) {
      warn(WarningCode::extension_unknown,
           "the file needs the extension " + printable(extension) + ", which is not known here");
    }
  }

  void tell_volumes(InstanceResult& placed) {
    constexpr std::size_t kMostNamed = 20;
    if (placed.none_printed && !source_.options.by_mesh) {
      warn(WarningCode::none_printed,
           "none of its items is to be printed: all are taken for the model");
    }
    std::size_t left_out = 0;
    for (const ModelVolume& volume : placed.volumes) {
      if (volume.fate != VolumeFate::left_out || ++left_out > kMostNamed) continue;
      warn(volume.role == VolumeRole::negative && volume.printed ? WarningCode::not_subtracted
                                                                 : WarningCode::objects_left_out,
           volume_words(volume) + " left out: " + why_left_out(volume));
    }
    if (left_out > kMostNamed) {
      warn_if(WarningCode::objects_left_out, left_out - kMostNamed, "more volume",
              " left out: no part of the model");
    }
    const bool is_empty = placed.soup.triangles.empty() && !source_.options.may_be_empty;
    if (is_empty && left_out > 0) {
      source_.fail("holds nothing of a model: " + result_.report.warnings.back().text);
    }
    result_.report.volumes = std::move(placed.volumes);
  }

  static std::string why_left_out(const ModelVolume& volume) {
    if (!volume.printed) return "it is not to be printed";
    if (volume.role == VolumeRole::negative) return "it is not subtracted";
    return "it is no part of the model";
  }

  void warn_if(WarningCode code, std::size_t count, std::string_view noun,
               const std::string& what) {
    if (count == 0) return;
    result_.report.warnings.push_back({code, counted(count, noun) + what, {{"count", count}}});
  }

  void keep_rest(InstanceResult& placed) {
    auto kept = std::make_shared<KeptPackage>();
    if (source_.options.by_mesh) kept->graph = std::move(placed.graph);
    if (source_.options.attributes) read_attributes(placed, *kept);
    kept->unit = parts_.front().unit;
    result_.attributes.keepsake = std::move(kept);
  }

  void read_attributes(const InstanceResult& placed, KeptPackage& kept) {
    types_.read(source_, archive_);
    std::unordered_set<std::string> taken;
    const FindPicture find = [&](const ModelPart& part, const ModelTexture& texture) {
      return picture_of(part, texture, kept, taken);
    };
    PropertyOddities oddities;
    result_.attributes = attributes_of(parts_, placed, find, oddities);
    warn_if(WarningCode::attributes_unreadable, oddities.missing, "triangle",
            " with properties that are not there");
    warn_if(WarningCode::attributes_unreadable, oddities.gradients, "triangle",
            " with several materials: that of the first corner");
    warn_if(WarningCode::attributes_unreadable, oddities.unreadable, "texture",
            " without a picture that can be read");
    warn_if(WarningCode::attributes_unreadable, oddities_.painted, "triangle",
            " with painted data of other programs: not kept");
    warn_if(WarningCode::attributes_unreadable, oddities_.unknown_groups, "group",
            " of properties left out: mixtures of materials, or too many layers");
    ModelPart& first = parts_.front();
    for (const ModelPart& part : parts_) add_namespaces(part.namespaces, kept.namespaces);
    kept.metadata = std::move(first.metadata);
    if (source_.options.by_mesh) kept.configs = configs_;
    keep_parts(source_, archive_, types_, first.name, taken, kept, result_.report);
    for (const KeptPackage::Part& part : kept.parts) {
      if (!result_.attributes.paints.empty() && is_print_settings(part_key(part.name))) {
        result_.attributes.filaments = read_filament_colours(*part.bytes);
      }
    }
  }

  // A prefix means what it meant first.
  static void add_namespaces(const std::vector<ModelNamespace>& from,
                             std::vector<ModelNamespace>& to) {
    for (const ModelNamespace& one : from) {
      const bool is_known = std::any_of(to.begin(), to.end(), [&](const ModelNamespace& known) {
        return known.prefix == one.prefix;
      });
      if (!is_known) to.push_back(one);
    }
  }

  std::optional<Image> picture_of(const ModelPart& part, const ModelTexture& texture,
                                  KeptPackage& kept, std::unordered_set<std::string>& taken) {
    const std::string name = part_name(texture.path, part.name);
    const ZipReader::Entry* const entry = name.empty() ? nullptr : archive_.find(name);
    if (entry == nullptr) return std::nullopt;
    Image image;
    image.name = last_of_part(name);
    image.media_type = texture.media_type;
    image.path = part_key(name);  // tells pictures apart for attributes_of()
    if (!taken.insert(image.path).second) return image;
    try {
      image.bytes = std::make_shared<const std::string>(archive_.text_of(*entry));
    } catch (const InputError&) {
      return std::nullopt;
    }
    kept.tilings.push_back({image.bytes, texture.tile_u, texture.tile_v, texture.filter});
    return image;
  }

  const MeshSource& source_;
  ZipReader archive_;
  ReadResult result_;
  std::vector<std::string> names_;  // of the parts
  std::unordered_map<std::string, std::uint32_t> number_of_part_;
  std::vector<ModelPart> parts_;
  std::vector<KeptPackage::Config> configs_;
  ModelOddities oddities_;
  ContentTypes types_;
  std::size_t missing_parts_ = 0;
  std::uint64_t packed_ = 0;  // bytes of the parts that were read
  double share_ = 0;
};

}  // namespace

bool begins_with_zip(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("PK\x03\x04"sv);
}

bool is_threemf(std::string_view bytes) {
  if (!begins_with_zip(bytes)) return false;
  try {
    const MeshSource source{bytes, {}};
    const ZipReader archive(source);
    const auto& entries = archive.entries();
    return std::any_of(entries.begin(), entries.end(),
                       [](const auto& entry) { return extension_of_part(entry.name) == "model"; });
  } catch (const InputError&) {
    return false;
  }
}

ReadResult read_threemf(const MeshSource& source) { return ThreemfReader(source).run(); }

}  // namespace meshrepair
