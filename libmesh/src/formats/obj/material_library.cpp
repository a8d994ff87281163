#include "material_library.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <system_error>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <base/error.h>
#include <mesh/named_files.h>

#include "formats/common/text_scanner.h"
#include "formats/common/text_writer.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

// With all folders; an empty path is this folder.
fs::path full(const fs::path& path) {
  return fs::absolute(path.empty() ? "." : path).lexically_normal();
}

struct Line {
  std::string_view key, rest;  // its first word, and what follows without the blanks around it
};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

Line split(std::string_view text) {
  text = trimmed(text);
  const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
  return {text.substr(0, end), trimmed(text.substr(end))};
}

// Calls visit(text of the line) for each, without its end.
template <class Visit>
void visit_lines(std::string_view text, const Visit& visit) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    visit(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

bool names_picture(std::string_view key) {
  constexpr std::array<std::string_view, 6> kKeys = {"bump", "disp", "decal",
                                                     "refl", "norm", "map_"};
  return std::any_of(kKeys.begin(), kKeys.end(), [&](std::string_view known) {
    return known.back() == '_' ? equals_ignoring_case(key.substr(0, known.size()), known)
                               : equals_ignoring_case(key, known);
  });
}

bool is_number(std::string_view word) {
  double value = 0;
  TextScanner text(word);
  return text.next_on_line() && text.read_real(value);
}

// How many words an option of a map takes at most, and whether they are numbers. Of -o, -s and -t
// the last two may be missing.
struct MapOption {
  std::string_view name;
  int words;
  bool numbers;
};

// Behind the options "-clamp on -s 1 1 1" of a map: the name of the picture, which may have blanks.
std::string_view picture_of(std::string_view rest) {
  constexpr std::array<MapOption, 12> kOptions = {{{"-blendu", 1, false},
                                                   {"-blendv", 1, false},
                                                   {"-boost", 1, true},
                                                   {"-mm", 2, true},
                                                   {"-o", 3, true},
                                                   {"-s", 3, true},
                                                   {"-t", 3, true},
                                                   {"-texres", 1, true},
                                                   {"-clamp", 1, false},
                                                   {"-bm", 1, true},
                                                   {"-imfchan", 1, false},
                                                   {"-type", 1, false}}};
  while (true) {
    const Line first = split(rest);
    const auto* const option =
        std::find_if(kOptions.begin(), kOptions.end(),
                     [&](const MapOption& known) { return known.name == first.key; });
    if (option == kOptions.end()) return rest;
    rest = first.rest;
    for (int i = 0; i < option->words; ++i) {
      const Line word = split(rest);
      if (word.rest.empty() || (option->numbers && !is_number(word.key))) break;
      rest = word.rest;
    }
  }
}

std::string with_slashes(std::string_view name) {
  std::string path(name);
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

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

// Reads one library.
class LibraryReader {
 public:
  LibraryReader(const MeshSource& source,
                const std::unordered_map<std::string_view, std::uint32_t>& numbers,
                const MaterialLibraries::Library& library, Attributes& attributes)
      : source_(source), numbers_(numbers), library_(library), attributes_(attributes) {}

  void run() {
    visit_lines(library_.text, [&](std::string_view text) { read(split(text)); });
  }

 private:
  void read(const Line& line) {
    if (line.key == "newmtl") {
      const auto found = numbers_.find(line.rest);
      look_ = found == numbers_.end() ? nullptr : &attributes_.looks[found->second];
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
      look_->image = image_of(with_slashes(picture_of(line.rest)));
    }
  }

  // None where the name leads out of the folder.
  std::uint32_t image_of(const std::string& name) {
    const std::string beside = name_beside(library_, name);
    Image image = picture_named(source_, beside);
    if (image.path.empty() && !image.bytes) return kNone;
    std::error_code error;
    if (fs::exists(image.path, error) && !find_named(source_, beside)) return kNone;
    const auto same = std::find_if(
        attributes_.images.begin(), attributes_.images.end(),
        [&](const Image& known) { return known.path == image.path && known.bytes == image.bytes; });
    const auto number = static_cast<std::uint32_t>(same - attributes_.images.begin());
    if (same == attributes_.images.end()) attributes_.images.push_back(std::move(image));
    return number;
  }

  const MeshSource& source_;
  const std::unordered_map<std::string_view, std::uint32_t>& numbers_;
  const MaterialLibraries::Library& library_;
  Attributes& attributes_;
  Material* look_ = nullptr;
};

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
    if (!library_.is_packed && full(library_.folder) == folder_) return library_.text;
    std::string moved;
    visit_lines(library_.text, [&](std::string_view text) {
      const Line line = split(text);
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
  // What is no way within the library's folder stays: nobody knows what it means elsewhere.
  [[nodiscard]] std::string moved_name(std::string_view name) const {
    if (library_.is_packed) {
      const auto picture = library_.pictures.find(name);
      if (picture == library_.pictures.end()) return std::string(name);
      return name_of_packed_(name, picture->second);
    }
    const std::string path = with_slashes(name);
    if (!stays_within(path)) return std::string(name);
    return name_seen_from(folder_, library_.folder / fs::path(path).lexically_normal());
  }

  const MaterialLibraries::Library& library_;
  fs::path folder_;
  NameOfPacked name_of_packed_;
};

std::unordered_set<std::string> materials_in(std::string_view text) {
  std::unordered_set<std::string> names;
  visit_lines(text, [&](std::string_view line) {
    const Line split_line = split(line);
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
  visit_lines(text, [&](std::string_view line) {
    const Line parts = split(line);
    if (parts.key == "newmtl") is_repeat = !known.emplace(parts.rest).second;
    if (!is_repeat) once.append(line).append("\n");
  });
  return once;
}

// Makes the files of one mesh.
class MaterialFiles {
 public:
  MaterialFiles(const fs::path& path, const Attributes& attributes)
      : path_(path), attributes_(attributes) {}

  std::vector<SideFile> run() {
    const auto* const known = dynamic_cast<const MaterialLibraries*>(attributes_.keepsake.get());
    std::string text;
    if (known != nullptr) {
      for (const MaterialLibraries::Library& library : known->libraries) {
        text += LibraryMover(library, path_.parent_path(),
                             [this](std::string_view name, const auto& bytes) {
                               return name_of_packed(name, bytes);
                             })
                    .run();
        if (!text.empty() && text.back() != '\n') text += '\n';
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
      if (look.image != kNone) text += "map_Kd " + name_of_image(look.image) + '\n';
    }
  }

  std::string name_of_image(std::uint32_t number) {
    const Image& image = attributes_.images[number];
    if (!image.bytes && image.path.empty()) return image.name;
    if (!image.bytes) {
      return name_seen_from(path_.parent_path(), image.path);
    }
    return written_picture(number, extension_of(image), *image.bytes);
  }

  std::string written_picture(std::size_t number, const std::string& extension,
                              const std::string& bytes) {
    std::string name = path_.stem().string() + "_" + std::to_string(number) + extension;
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
    return written_picture(number, fs::path(name).extension().string(), *bytes);
  }

  // Never over a library of the input that is another now.
  [[nodiscard]] fs::path library_path(const MaterialLibraries* known,
                                      const std::string& text) const {
    fs::path path = path_;
    path.replace_extension(".mtl");
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
      path.replace_filename(path_.stem().string() + "_" + std::to_string(i) + ".mtl");
    }
    return path;
  }

  const fs::path& path_;
  const Attributes& attributes_;
  std::vector<SideFile> files_;
  std::unordered_set<std::size_t> written_;                 // pictures, by their numbers
  std::vector<std::shared_ptr<const std::string>> others_;  // pictures that are no images
};

void take_packed_pictures(const MeshSource& source, MaterialLibraries::Library& library) {
  visit_lines(library.text, [&](std::string_view text) {
    const Line line = split(text);
    if (!names_picture(line.key)) return;
    const std::string_view name = picture_of(line.rest);
    const Image image = picture_named(source, name_beside(library, with_slashes(name)));
    if (image.bytes) library.pictures.emplace(name, image.bytes);
  });
}

MaterialLibraries::Library read_library(const MeshSource& source, const std::string& name,
                                        ReadReport& report) {
  MaterialLibraries::Library library;
  library.name = name;
  if (const auto file = read_named(source, with_slashes(name))) {
    library.text = file->bytes;
    library.path = file->path;
    library.folder = file->path.parent_path();
    library.is_packed = source.beside != nullptr;
    if (library.is_packed) take_packed_pictures(source, library);
  } else if (source.folder || source.beside != nullptr) {
    std::string warning = "the library of materials " + printable(name) + " is not in ";
    warning += place_of_named(source);
    report.warnings.push_back(std::move(warning));
  }
  return library;
}

}  // namespace

std::shared_ptr<const Keepsake> MaterialLibraries::joined(const Keepsake& other) const {
  const auto* const others = dynamic_cast<const MaterialLibraries*>(&other);
  if (others == nullptr) return nullptr;
  auto all = std::make_shared<MaterialLibraries>();
  all->libraries = libraries;
  for (const Library& library : others->libraries) {
    const bool is_known = std::any_of(libraries.begin(), libraries.end(),
                                      [&](const Library& known) { return known.is_like(library); });
    if (!is_known) all->libraries.push_back(library);
  }
  return all;
}

bool MaterialLibraries::Library::is_like(const Library& other) const {
  const auto same_picture = [](const auto& a, const auto& b) {
    return a.first == b.first && *a.second == *b.second;
  };
  return text == other.text && folder == other.folder && is_packed == other.is_packed &&
         std::equal(pictures.begin(), pictures.end(), other.pictures.begin(), other.pictures.end(),
                    same_picture);
}

void read_material_libraries(const MeshSource& source, const std::vector<std::string>& names,
                             Attributes& attributes, ReadReport& report) {
  if (names.empty()) return;
  auto kept = std::make_shared<MaterialLibraries>();
  for (const std::string& name : names) {
    kept->libraries.push_back(read_library(source, name, report));
  }
  std::unordered_map<std::string_view, std::uint32_t> numbers;
  for (std::uint32_t m = 0; m < attributes.materials.names.size(); ++m) {
    numbers.emplace(attributes.materials.names[m], m);
  }
  attributes.looks.resize(attributes.materials.names.size());
  for (const MaterialLibraries::Library& library : kept->libraries) {
    LibraryReader(source, numbers, library, attributes).run();
  }
  attributes.keepsake = std::move(kept);
}

std::vector<SideFile> material_files(const fs::path& path, const Attributes& attributes) {
  return MaterialFiles(path, attributes).run();
}

std::string unread_libraries(const Attributes& attributes) {
  std::string lines;
  const auto* const known = dynamic_cast<const MaterialLibraries*>(attributes.keepsake.get());
  if (known == nullptr) return lines;
  for (const MaterialLibraries::Library& library : known->libraries) {
    if (library.path.empty() && !library.is_packed) lines += "mtllib " + library.name + "\n";
  }
  return lines;
}

}  // namespace meshrepair
