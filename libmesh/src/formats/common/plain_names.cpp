// SPDX-License-Identifier: MIT
#include "plain_names.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "text_scanner.h"

namespace meshrepair {
namespace {

// What names of a format cannot have.
class PlainNames {
 public:
  explicit PlainNames(NameLines lines) : lines_(lines) {}

  [[nodiscard]] bool is_plain_name(std::string_view name) const {
    return plain_name(std::string(name)) == name;
  }

  [[nodiscard]] std::string plain_name(std::string name) const {
    const auto is_control = [](unsigned char c) { return c < ' ' || c == 0x7F; };
    std::replace_if(name.begin(), name.end(), is_control, '_');
    if (name.ends_with('\\')) name.back() = '_';
    if (lines_ == NameLines::ply || name.empty()) return name;
    if (name.ends_with(' ')) name.back() = '_';
    if (name.starts_with(' ')) name.front() = '_';
    if (lines_ == NameLines::stl) return without_facets(std::move(name));
    // A word that begins so, and all behind it, is a comment.
    for (std::size_t i = 0; i < name.size(); ++i) {
      if (name[i] == '#' && (i == 0 || name[i - 1] == ' ')) name[i] = '_';
    }
    return name;
  }

  void make_plain(std::vector<std::string>& names) const;
  [[nodiscard]] bool are_plain(const TriangleLabels& labels) const;

 private:
  // Behind the name of a solid facets may stand in its line.
  static std::string without_facets(std::string name) {
    constexpr std::string_view kFacet = "facet ";
    std::size_t at = 0;
    for (;;) {
      const std::size_t found = find_ignoring_case(std::string_view(name).substr(at), kFacet);
      if (found == std::string_view::npos) return name;
      at += found + kFacet.size();
      name[at - 1] = '_';
    }
  }

  NameLines lines_;
};

void PlainNames::make_plain(std::vector<std::string>& names) const {
  std::unordered_set<std::string> taken;
  for (const std::string& name : names) {
    if (is_plain_name(name)) taken.insert(name);
  }
  for (std::string& name : names) {
    if (is_plain_name(name)) continue;
    const std::string plain = plain_name(name);
    name = plain;
    for (int i = 2; !taken.insert(name).second; ++i) {
      name = plain;
      name.append("_").append(std::to_string(i));
    }
  }
}

bool PlainNames::are_plain(const TriangleLabels& labels) const {
  return std::all_of(labels.names.begin(), labels.names.end(),
                     [&](const std::string& name) { return is_plain_name(name); });
}

}  // namespace

std::optional<Attributes> with_plain_names(const Attributes& attributes, NameLines lines) {
  const PlainNames names(lines);
  const bool are_all =
      names.are_plain(attributes.materials) && names.are_plain(attributes.groups) &&
      names.are_plain(attributes.objects) && names.are_plain(attributes.smoothing) &&
      std::all_of(attributes.corners.begin(), attributes.corners.end(),
                  [&](const CornerAttribute& one) { return names.is_plain_name(one.name); }) &&
      std::all_of(attributes.images.begin(), attributes.images.end(), [&](const Image& one) {
        return names.is_plain_name(one.name) && names.is_plain_name(one.path);
      });
  if (are_all) return std::nullopt;
  Attributes plain = attributes;
  for (TriangleLabels* labels :
       {&plain.materials, &plain.groups, &plain.objects, &plain.smoothing}) {
    names.make_plain(labels->names);
  }
  for (CornerAttribute& attribute : plain.corners) {
    attribute.name = names.plain_name(attribute.name);
  }
  for (Image& image : plain.images) {
    image.name = names.plain_name(image.name);
    // A path that no line can name is none; '#' stands in many names of files.
    if (!PlainNames(NameLines::ply).is_plain_name(image.path)) image.path.clear();
  }
  return plain;
}

std::string plain_obj_name(const std::string& name) {
  return PlainNames(NameLines::obj).plain_name(name);
}

}  // namespace meshrepair
