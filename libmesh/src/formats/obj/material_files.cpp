// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string_view>
#include <system_error>
#include <unordered_set>
#include <utility>

#include <mesh/named_files.h>

#include "formats/common/plain_names.h"
#include "formats/common/text_writer.h"
#include "material_library.h"
#include "mtl_text.h"
#include "obj_io.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

// With all folders; an empty path is this folder.
fs::path full(const fs::path& path) {
  return fs::absolute(path.empty() ? "." : path).lexically_normal();
}

using NameOfPacked =
    std::function<std::string(std::string_view, const std::shared_ptr<const std::string>&)>;

// A text in which pictures have names relative to another folder. Those of an archive have names
// there that `name_of_packed` gives them.
class LibraryMover {
 public:
  LibraryMover(const MaterialLibraries::Library& library, const fs::path& folder,
               NameOfPacked name_of_packed)
      : library_(library), folder_(full(folder)), name_of_packed_(std::move(name_of_packed)) {}

  std::string run() {
    const bool is_right = library_.real_names.empty() && full(library_.folder) == folder_;
    if (!library_.is_packed && is_right) return library_.text;
    std::string moved;
    visit_mtl_lines(library_.text, [&](std::string_view text) {
      const MtlLine line = split_mtl_line(text);
      if (!names_picture(line.key)) {
        moved += text;
      } else {
        const std::string_view name = picture_of(line.rest);
        moved += text.substr(0, static_cast<std::size_t>(name.data() - text.data()));
        moved += moved_name(name);
      }
      moved += '\n';
    });
    return moved;
  }

 private:
  // What leads farther than it may stays: nobody knows what it means elsewhere.
  [[nodiscard]] std::string moved_name(std::string_view name) const {
    if (library_.is_packed) {
      const auto picture = library_.pictures.find(name);
      if (picture == library_.pictures.end()) return std::string(name);
      return name_of_packed_(name, picture->second);
    }
    const auto real = library_.real_names.find(name);
    if (real != library_.real_names.end()) return name_seen_from(folder_, real->second);
    const std::string path = with_slashes(name);
    if (!stays_within(path, library_.levels_up)) return std::string(name);
    return name_seen_from(folder_, library_.folder / fs::path(path).lexically_normal());
  }

  const MaterialLibraries::Library& library_;
  fs::path folder_;
  NameOfPacked name_of_packed_;
};

std::unordered_set<std::string> materials_in(std::string_view text) {
  std::unordered_set<std::string> names;
  visit_mtl_lines(text, [&](std::string_view line) {
    const MtlLine split_line = split_mtl_line(line);
    if (split_line.key == "newmtl") names.emplace(split_line.rest);
  });
  return names;
}

std::string extension_of(const Image& image) {
  if (image.media_type == "image/png") return ".png";
  if (image.media_type == "image/jpeg") return ".jpg";
  if (image.media_type == "image/webp") return ".webp";
  return fs::path(image.name).extension().string();
}

// Without materials whose name was there before: in libraries of several meshes they are others,
// and have other names now.
std::string without_repeats(std::string_view text) {
  std::unordered_set<std::string> known;
  std::string once;
  bool is_repeat = false;
  visit_mtl_lines(text, [&](std::string_view line) {
    const MtlLine parts = split_mtl_line(line);
    if (parts.key == "newmtl") is_repeat = !known.emplace(parts.rest).second;
    if (!is_repeat) once.append(line).append("\n");
  });
  return once;
}

void append_library(std::string_view library, std::string& text) {
  const bool has_mark = library.starts_with(kByteOrderMark);
  text += has_mark && !text.empty() ? library.substr(kByteOrderMark.size()) : library;
  if (!text.empty() && text.back() != '\n') text += '\n';
}

// Makes the files of one mesh.
class MaterialFiles {
 public:
  MaterialFiles(const fs::path& path, const fs::path& names_from, const Attributes& attributes)
      : path_(path), names_from_(names_from), attributes_(attributes) {}

  std::vector<BundledFile> run() {
    const auto* const known = dynamic_cast<const MaterialLibraries*>(attributes_.keepsake.get());
    std::string text;
    if (known != nullptr) {
      for (const MaterialLibraries::Library& library : known->libraries) {
        const auto name = [this](std::string_view picture, const auto& bytes) {
          return name_of_packed(picture, bytes);
        };
        append_library(LibraryMover(library, names_from_, name).run(), text);
      }
    }
    if (known != nullptr && known->libraries.size() > 1) text = without_repeats(text);
    const bool is_read = !text.empty();
    append_others(text);
    if (text.empty() || (!is_read && attributes_.looks.empty())) return {};
    files_.push_back({library_path(known, text), std::move(text)});
    return std::move(files_);
  }

 private:
  // Materials that no library has.
  void append_others(std::string& text) {
    const std::unordered_set<std::string> known = materials_in(text);
    for (std::size_t m = 0; m < attributes_.materials.names.size(); ++m) {
      const std::string& name = attributes_.materials.names[m];
      if (known.contains(name)) continue;
      const Material look = m < attributes_.looks.size() ? attributes_.looks[m] : Material();
      text += "newmtl " + name + "\nKd ";
      append_triple(text, look.colour.data());
      text += '\n';
      if (look.colour[3] < 1) {
        text += "d ";
        append_number(text, look.colour[3]);
        text += '\n';
      }
      if (look.image == kNone) continue;
      const auto clamp = TextureSampling::Wrap::clamp;
      const bool is_clamped = look.sampling.wrap == std::array{clamp, clamp};
      text += is_clamped ? "map_Kd -clamp on " : "map_Kd ";
      text += name_of_image(look.image) + '\n';
    }
  }

  std::string name_of_image(std::uint32_t number) {
    const Image& image = attributes_.images[number];
    if (!image.bytes && image.path.empty()) return image.name;
    if (!image.bytes) {
      return name_seen_from(names_from_, image.path);
    }
    return written_picture(number, extension_of(image), *image.bytes);
  }

  std::string written_picture(std::size_t number, const std::string& extension,
                              const std::string& bytes) {
    const std::string stem = path_.stem().string() + "_" + std::to_string(number);
    std::string name = plain_obj_name(stem + extension);
    if (written_.insert(number).second) files_.push_back({path_.parent_path() / name, bytes});
    return name;
  }

  // Of a picture that is in an archive, maybe one that no material's colour needs.
  std::string name_of_packed(std::string_view name,
                             const std::shared_ptr<const std::string>& bytes) {
    const auto& images = attributes_.images;
    const auto same = std::find_if(images.begin(), images.end(),
                                   [&](const Image& image) { return image.bytes == bytes; });
    if (same != images.end()) {
      return name_of_image(static_cast<std::uint32_t>(same - images.begin()));
    }
    const auto known = std::find(others_.begin(), others_.end(), bytes);
    const std::size_t number = images.size() + static_cast<std::size_t>(known - others_.begin());
    if (known == others_.end()) others_.push_back(bytes);
    std::string extension = fs::path(name).extension().string();
    std::erase(extension, '"');
    return written_picture(number, extension, *bytes);
  }

  // Never over a library of the input that is another now.
  [[nodiscard]] fs::path library_path(const MaterialLibraries* known,
                                      const std::string& text) const {
    fs::path path = path_;
    path.replace_extension(".mtl");
    path.replace_filename(plain_obj_name(path.filename().string()));
    const auto is_in_use = [&] {
      return known != nullptr && std::any_of(known->libraries.begin(), known->libraries.end(),
                                             [&](const MaterialLibraries::Library& library) {
                                               std::error_code error;
                                               return !library.path.empty() &&
                                                      library.text != text &&
                                                      fs::equivalent(path, library.path, error);
                                             });
    };
    for (int i = 1; is_in_use(); ++i) {
      const std::string name = path_.stem().string() + "_" + std::to_string(i) + ".mtl";
      path.replace_filename(plain_obj_name(name));
    }
    return path;
  }

  const fs::path &path_, &names_from_;
  const Attributes& attributes_;
  std::vector<BundledFile> files_;
  std::unordered_set<std::size_t> written_;                 // pictures, by their numbers
  std::vector<std::shared_ptr<const std::string>> others_;  // pictures that are no images
};

}  // namespace

std::vector<BundledFile> material_files(const fs::path& path, const fs::path& names_from,
                                        const Attributes& attributes) {
  return MaterialFiles(path, names_from, attributes).run();
}

std::unordered_set<std::string> library_materials(const Attributes& attributes) {
  std::unordered_set<std::string> names;
  const auto* const known = dynamic_cast<const MaterialLibraries*>(attributes.keepsake.get());
  if (known == nullptr) return names;
  for (const MaterialLibraries::Library& library : known->libraries) {
    names.merge(materials_in(library.text));
  }
  return names;
}

std::string unread_libraries(const Attributes& attributes) {
  std::string lines;
  const auto* const known = dynamic_cast<const MaterialLibraries*>(attributes.keepsake.get());
  if (known == nullptr) return lines;
  for (const MaterialLibraries::Library& library : known->libraries) {
    if (!library.path.empty() || library.is_packed) continue;
    lines.append("mtllib ").append(plain_obj_name(library.name)).append("\n");
  }
  return lines;
}

}  // namespace meshrepair
