// SPDX-License-Identifier: MIT
#include "material_library.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <system_error>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <base/error.h>
#include <mesh/named_files.h>

#include "formats/common/text_scanner.h"
#include "joined_libraries.h"
#include "mtl_text.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

std::optional<std::array<double, 3>> numbers_of(std::string_view rest) {
  TextScanner text(rest);
  std::array<double, 3> values{};
  for (double& value : values) {
    if (!text.next_on_line() || !text.read_real(value)) return std::nullopt;
  }
  return values;
}

// The name of a picture as the mesh would have it.
std::string name_beside(const MaterialLibraries::Library& library, const std::string& name) {
  return (fs::path(with_slashes(library.name)).parent_path() / name).generic_string();
}

// How many folders up from that of the library a name may lead.
std::size_t levels_up_from(const MeshSource& source, const MaterialLibraries::Library& library) {
  std::size_t levels = source.levels_up;
  for (const fs::path& part :
       fs::path(with_slashes(library.name)).lexically_normal().parent_path()) {
    levels = part == ".." ? levels - 1 : levels + 1;
  }
  return levels;
}

// Reads one library. Of several, the first that defines a material counts, as in what is written.
class LibraryReader {
 public:
  LibraryReader(const MeshSource& source,
                const std::unordered_map<std::string_view, std::uint32_t>& numbers,
                const MaterialLibraries::Library& library, Attributes& attributes,
                std::unordered_set<std::uint32_t>& defined)
      : source_(source),
        numbers_(numbers),
        library_(library),
        attributes_(attributes),
        defined_(defined) {}

  void run() {
    visit_mtl_lines(library_.text, [&](std::string_view text) { read(split_mtl_line(text)); });
    defined_.insert(own_.begin(), own_.end());
  }

 private:
  void read(const MtlLine& line) {
    if (line.key == "newmtl") {
      const auto found = numbers_.find(line.rest);
      const bool is_own = found != numbers_.end() && !defined_.contains(found->second);
      look_ = is_own ? &attributes_.looks[found->second] : nullptr;
      if (is_own) own_.insert(found->second);
    } else if (look_ == nullptr) {
      return;
    } else if (line.key == "Kd") {
      if (const auto colour = numbers_of(line.rest)) {
        std::copy(colour->begin(), colour->end(), look_->colour.begin());
      }
    } else if (line.key == "d" || line.key == "Tr") {
      double value = 0;
      TextScanner text(line.rest);
      if (!text.next_on_line() || !text.read_real(value)) return;
      look_->colour[3] = std::clamp(line.key == "d" ? value : 1 - value, 0.0, 1.0);
    } else if (equals_ignoring_case(line.key, "map_kd")) {
      set_picture(read_mtl_map(line.rest));
    }
  }

  // v grows upwards here, but not in the transform.
  void set_picture(const MtlMap& map) {
    look_->image = image_of(with_slashes(map.picture));
    using Wrap = TextureSampling::Wrap;
    look_->sampling.wrap.fill(map.is_clamped ? Wrap::clamp : Wrap::repeat);
    look_->transform.scale = map.scale;
    look_->transform.offset = {map.offset[0], 1 - map.scale[1] - map.offset[1]};
  }

  // Whether there is such a file or not: who wants to draw says so where it cannot be opened.
  std::uint32_t image_of(const std::string& name) {
    if (name.empty()) return kNone;
    const std::string beside = name_beside(library_, name);
    Image image = picture_named(source_, beside);
    if (image.path.empty() && !image.bytes) image.name = name;
    const auto same =
        std::find_if(attributes_.images.begin(), attributes_.images.end(), [&](const Image& known) {
          return known.path == image.path && known.bytes == image.bytes && known.name == image.name;
        });
    const auto number = static_cast<std::uint32_t>(same - attributes_.images.begin());
    if (same == attributes_.images.end()) attributes_.images.push_back(std::move(image));
    return number;
  }

  const MeshSource& source_;
  const std::unordered_map<std::string_view, std::uint32_t>& numbers_;
  const MaterialLibraries::Library& library_;
  Attributes& attributes_;
  std::unordered_set<std::uint32_t>& defined_;  // by those before
  std::unordered_set<std::uint32_t> own_;
  Material* look_ = nullptr;
};

// Notes their names, and takes those that are packed.
void look_at_pictures(const MeshSource& source, MaterialLibraries::Library& library) {
  visit_mtl_lines(library.text, [&](std::string_view text) {
    const MtlLine line = split_mtl_line(text);
    if (!names_picture(line.key)) return;
    const std::string_view name = picture_of(line.rest);
    const std::string beside = name_beside(library, with_slashes(name));
    const Image image = picture_named(source, beside);
    if (image.bytes) library.pictures.emplace(name, image.bytes);
    const std::string found = library.is_packed ? beside : name_as_found(source, beside);
    if (found != beside) library.real_names.emplace(name, *source.folder / found);
  });
}

MaterialLibraries::Library read_library(const MeshSource& source, const std::string& name,
                                        ReadReport& report) {
  MaterialLibraries::Library library;
  library.name = name;
  if (const auto file = read_named(source, with_slashes(name))) {
    library.name = name_as_found(source, with_slashes(name));
    library.text = file->bytes;
    library.path = file->path;
    library.folder = file->path.parent_path();
    library.is_packed = source.beside != nullptr;
    if (!library.is_packed) library.levels_up = levels_up_from(source, library);
    look_at_pictures(source, library);
  } else {
    const bool has_place = source.folder || source.beside != nullptr;
    std::string warning = "the library of materials " + printable(name) + " is not ";
    warning += has_place ? "in " : "looked for: the mesh is no file in a folder";
    if (has_place) warning += place_of_named(source);
    report.warnings.push_back({WarningCode::materials_undefined, std::move(warning)});
  }
  return library;
}

constexpr std::size_t kLongestKey = 20, kLongestWords = 60;

// What other formats can say, too.
bool is_in_looks(std::string_view key) {
  return key == "newmtl" || key == "Kd" || key == "d" || key == "Tr" ||
         equals_ignoring_case(key, "map_kd");
}

// One line may name several libraries: "a.mtl my b.mtl". But names have blanks, too.
std::vector<std::string_view> names_in(const MeshSource& source, std::string_view line) {
  constexpr std::string_view kExtension = ".mtl";
  std::vector<std::string_view> names;
  if (has_named(source, with_slashes(line))) return {line};
  while (!line.empty()) {
    std::size_t end = find_ignoring_case(line, kExtension);
    end = end == std::string_view::npos ? line.size() : end + kExtension.size();
    while (end < line.size() && line[end] != ' ' && line[end] != '\t') ++end;
    names.push_back(line.substr(0, end));
    line.remove_prefix(end);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  }
  return names;
}

// Who misses a library knows it already.
void warn_of_undefined(const MaterialLibraries& libraries, const std::vector<std::string>& names,
                       ReadReport& report) {
  std::unordered_set<std::string_view> defined;
  for (const MaterialLibraries::Library& library : libraries.libraries) {
    if (library.path.empty() && !library.is_packed) return;
    visit_mtl_lines(library.text, [&](std::string_view text) {
      const MtlLine line = split_mtl_line(text);
      if (line.key == "newmtl") defined.insert(line.rest);
    });
  }
  const auto is_undefined = [&](const std::string& name) { return !defined.contains(name); };
  const auto first = std::find_if(names.begin(), names.end(), is_undefined);
  if (first == names.end()) return;
  const auto count = static_cast<std::size_t>(std::count_if(first, names.end(), is_undefined));
  report.warnings.push_back({WarningCode::materials_undefined,
                             count == 1 ? "no library defines the material " + printable(*first)
                                        : "no library defines " + counted(count, "material") +
                                              ": " + printable(*first) + ", ...",
                             {{"materials", count}}});
}

}  // namespace

std::vector<std::string> MaterialLibraries::lost_in(SoupFormat format) const {
  if (format == SoupFormat::obj) return {};
  std::set<std::string> keys;
  for (const Library& library : libraries) {
    visit_mtl_lines(library.text, [&](std::string_view line) {
      const std::string_view key = split_mtl_line(line).key;
      if (!key.empty() && key.front() != '#' && !is_in_looks(key)) keys.emplace(key);
    });
  }
  std::string words;
  for (const std::string& key : keys) {
    if (key.size() > kLongestKey) continue;  // of no program
    words.append(words.empty() ? "" : " ").append(key);
    if (words.size() < kLongestWords) continue;
    words += " and more";
    break;
  }
  if (words.empty()) return {};
  return {words + " of materials"};
}

std::shared_ptr<const Keepsake> MaterialLibraries::appended_to(const Keepsake* first,
                                                               AppendedMaterials& materials) const {
  const auto* const before = dynamic_cast<const MaterialLibraries*>(first);
  if (first != nullptr && before == nullptr) return nullptr;
  return joined_libraries(before, *this, materials);
}

bool MaterialLibraries::Library::is_like(const Library& other) const {
  const auto same_picture = [](const auto& a, const auto& b) {
    return a.first == b.first && *a.second == *b.second;
  };
  return text == other.text && folder == other.folder && is_packed == other.is_packed &&
         std::equal(pictures.begin(), pictures.end(), other.pictures.begin(), other.pictures.end(),
                    same_picture);
}

void read_material_libraries(const MeshSource& source, const std::vector<std::string>& lines,
                             Attributes& attributes, ReadReport& report) {
  if (lines.empty()) return;
  auto kept = std::make_shared<MaterialLibraries>();
  for (const std::string& line : lines) {
    for (const std::string_view name : names_in(source, line)) {
      kept->libraries.push_back(read_library(source, std::string(name), report));
    }
  }
  std::unordered_map<std::string_view, std::uint32_t> numbers;
  for (std::uint32_t m = 0; m < attributes.materials.names.size(); ++m) {
    numbers.emplace(attributes.materials.names[m], m);
  }
  attributes.looks.resize(attributes.materials.names.size());
  std::unordered_set<std::uint32_t> defined;
  for (const MaterialLibraries::Library& library : kept->libraries) {
    LibraryReader(source, numbers, library, attributes, defined).run();
  }
  warn_of_undefined(*kept, attributes.materials.names, report);
  attributes.keepsake = std::move(kept);
}

}  // namespace meshrepair
