#include "plain_names.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace meshrepair {
namespace {

bool is_control(char c) { return (c >= 0 && c < ' ') || c == 0x7F; }

bool is_plain_name(std::string_view name) {
  return std::none_of(name.begin(), name.end(), is_control) && !name.ends_with('\\');
}

std::string plain_name(std::string name) {
  std::replace_if(name.begin(), name.end(), is_control, '_');
  if (name.ends_with('\\')) name.back() = '_';
  return name;
}

void make_plain(std::vector<std::string>& names) {
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

bool are_plain(const TriangleLabels& labels) {
  return std::all_of(labels.names.begin(), labels.names.end(), is_plain_name);
}

}  // namespace

std::optional<Attributes> with_plain_names(const Attributes& attributes) {
  const bool are_all =
      are_plain(attributes.materials) && are_plain(attributes.groups) &&
      are_plain(attributes.objects) && are_plain(attributes.smoothing) &&
      std::all_of(attributes.corners.begin(), attributes.corners.end(),
                  [](const CornerAttribute& one) { return is_plain_name(one.name); }) &&
      std::all_of(attributes.images.begin(), attributes.images.end(), [](const Image& one) {
        return is_plain_name(one.name) && is_plain_name(one.path);
      });
  if (are_all) return std::nullopt;
  Attributes plain = attributes;
  for (TriangleLabels* labels :
       {&plain.materials, &plain.groups, &plain.objects, &plain.smoothing}) {
    make_plain(labels->names);
  }
  for (CornerAttribute& attribute : plain.corners) attribute.name = plain_name(attribute.name);
  for (Image& image : plain.images) {
    image.name = plain_name(image.name);
    if (!is_plain_name(image.path)) image.path.clear();
  }
  return plain;
}

}  // namespace meshrepair
