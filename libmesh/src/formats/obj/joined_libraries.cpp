// SPDX-License-Identifier: MIT
#include "joined_libraries.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "mtl_text.h"

namespace meshrepair {
namespace {

using Library = MaterialLibraries::Library;

// Lines from `newmtl` to the next one.
struct Definition {
  const Library* library = nullptr;
  std::string_view text;
};

using Definitions = std::unordered_map<std::string_view, Definition>;

// By the names of the materials; the first one of a name counts.
Definitions definitions_in(const MaterialLibraries& libraries) {
  Definitions found;
  for (const Library& library : libraries.libraries) {
    std::optional<std::string_view> name;
    std::string_view rest;  // from the line of that name on
    const auto finish = [&](const char* end) {
      if (!name) return;
      const auto length = static_cast<std::size_t>(end - rest.data());
      found.try_emplace(*name, Definition{&library, rest.substr(0, length)});
    };
    const std::string_view all = library.text;
    visit_mtl_lines(all, [&](std::string_view text) {
      const MtlLine line = split_mtl_line(text);
      if (line.key != "newmtl") return;
      finish(text.data());
      name = line.rest;
      rest = all.substr(static_cast<std::size_t>(text.data() - all.data()));
    });
    finish(all.data() + all.size());
  }
  return found;
}

// What tells apart what two definitions say, whatever their libraries are: pictures by where they
// are, or by their bytes.
std::string meaning_of(const Definition& definition) {
  const Library& library = *definition.library;
  std::string meaning;
  visit_mtl_lines(definition.text, [&](std::string_view text) {
    const MtlLine line = split_mtl_line(text);
    if (line.key.empty() || line.key.front() == '#') return;
    meaning.append(line.key).append(1, ' ');
    if (!names_picture(line.key)) {
      meaning.append(line.rest).append(1, '\n');
      return;
    }
    const std::string_view name = picture_of(line.rest);
    meaning.append(line.rest.substr(0, line.rest.size() - name.size()));
    const auto packed = library.pictures.find(name);
    if (packed != library.pictures.end()) {
      meaning += *packed->second;
    } else {
      meaning += (library.folder / with_slashes(name)).lexically_normal().generic_string();
    }
    meaning += '\n';
  });
  return meaning;
}

class LibraryJoiner {
 public:
  LibraryJoiner(const MaterialLibraries* first, const MaterialLibraries& second,
                AppendedMaterials& materials)
      : first_(first), second_(second), materials_(materials), new_(definitions_in(second)) {
    if (first != nullptr) old_ = definitions_in(*first);
    for (const Definitions* one : {&old_, &new_}) {
      for (const auto& [name, definition] : *one) materials.take_name(std::string(name));
    }
  }

  std::shared_ptr<const MaterialLibraries> run() {
    rename();
    if (first_ == nullptr && renamed_.empty()) return nullptr;
    auto all = std::make_shared<MaterialLibraries>();
    if (first_ != nullptr) all->libraries = first_->libraries;
    const std::size_t before = all->libraries.size();
    for (const Library& library : second_.libraries) {
      Library other = with_new_names(library);
      const auto end = all->libraries.begin() + static_cast<std::ptrdiff_t>(before);
      const bool is_known = std::any_of(all->libraries.begin(), end,
                                        [&](const Library& known) { return known.is_like(other); });
      if (!is_known) all->libraries.push_back(std::move(other));
    }
    return all;
  }

 private:
  // In the order of the text, and then of the mesh: new names have numbers.
  void rename() {
    for (const Library& library : second_.libraries) {
      visit_mtl_lines(library.text, [&](std::string_view text) {
        const MtlLine line = split_mtl_line(text);
        if (line.key == "newmtl") rename_if_other(std::string(line.rest));
      });
    }
    for (const std::string& name : materials_.other.materials.names) rename_if_other(name);
  }

  void rename_if_other(const std::string& name) {
    if (renamed_.contains(name) || !is_other(name)) return;
    renamed_.emplace(name, materials_.free_name(name));
    materials_.new_names[name] = renamed_.at(name);
  }

  // Than what the first mesh has of this name.
  [[nodiscard]] bool is_other(const std::string& name) const {
    const auto before = old_.find(name), now = new_.find(name);
    if (before != old_.end() && now != new_.end()) {
      return meaning_of(before->second) != meaning_of(now->second);
    }
    if (before == old_.end() && now == new_.end()) return false;
    const auto& names = materials_.all.materials.names;
    return before != old_.end() || std::find(names.begin(), names.end(), name) != names.end();
  }

  [[nodiscard]] Library with_new_names(const Library& library) const {
    Library result = library;
    result.text.clear();
    visit_mtl_lines(library.text, [&](std::string_view text) {
      const MtlLine line = split_mtl_line(text);
      const auto found =
          line.key == "newmtl" ? renamed_.find(std::string(line.rest)) : renamed_.end();
      if (found == renamed_.end()) {
        result.text += text;
      } else {
        result.text += "newmtl " + found->second;
      }
      result.text += '\n';
    });
    if (!library.text.ends_with('\n') && !result.text.empty()) result.text.pop_back();
    return result;
  }

  const MaterialLibraries* first_;
  const MaterialLibraries& second_;
  AppendedMaterials& materials_;
  Definitions old_, new_;
  std::unordered_map<std::string, std::string> renamed_;
};

}  // namespace

std::shared_ptr<const MaterialLibraries> joined_libraries(const MaterialLibraries* first,
                                                          const MaterialLibraries& second,
                                                          AppendedMaterials& materials) {
  return LibraryJoiner(first, second, materials).run();
}

}  // namespace meshrepair
