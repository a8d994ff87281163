#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>

#include <mesh/attributes.h>

namespace meshrepair {
namespace {

bool same_look(const Attributes& all, const Material& a, const Material& b) {
  if (a.colour != b.colour || (a.image == kNone) != (b.image == kNone)) return false;
  if (a.image == kNone) return true;
  if (a.texture_set != b.texture_set || a.transform != b.transform) return false;
  const Image &first = all.images[a.image], &second = all.images[b.image];
  if (first.bytes && second.bytes) return *first.bytes == *second.bytes;
  return !first.bytes && !second.bytes && first.path == second.path;
}

void append_corners(CornerAttribute& to, CornerAttribute from) {
  const auto first = static_cast<std::uint32_t>(to.count());
  to.values.insert(to.values.end(), from.values.begin(), from.values.end());
  for (const std::uint32_t value : from.of_corner) {
    to.of_corner.push_back(value == kNone ? kNone : first + value);
  }
  if (to.storage != from.storage) to.storage = CornerAttribute::Storage::real64;
  if (to.place != from.place) to.place = CornerAttribute::Place::corner;
}

// Attributes that may be one: the k-th of a kind, a name and a number of components.
bool same_set(const CornerAttribute& a, const CornerAttribute& b) {
  return a.kind == b.kind && a.name == b.name && a.components == b.components;
}

std::uint32_t texture_sets_before(const Attributes& all, std::size_t set) {
  return static_cast<std::uint32_t>(std::count_if(
      all.corners.begin(), all.corners.begin() + static_cast<std::ptrdiff_t>(set),
      [](const CornerAttribute& one) { return one.kind == CornerAttribute::Kind::texture; }));
}

// Materials of the other say by number which set of texture coordinates they use.
void append_all_corners(Attributes& all, std::size_t triangles, Attributes& other,
                        std::size_t triangles_of_other) {
  std::vector<char> is_taken(all.corners.size(), 0);
  std::vector<std::uint32_t> new_number;  // of the sets of texture coordinates
  for (CornerAttribute& from : other.corners) {
    std::size_t to = 0;
    while (to < all.corners.size() &&
           ((to < is_taken.size() && is_taken[to] != 0) || !same_set(all.corners[to], from))) {
      ++to;
    }
    if (to == all.corners.size()) {
      CornerAttribute fresh = from;
      fresh.values.clear();
      fresh.of_corner.assign(3 * triangles, kNone);
      all.corners.push_back(std::move(fresh));
      is_taken.resize(all.corners.size(), 0);
    }
    is_taken[to] = 1;
    if (from.kind == CornerAttribute::Kind::texture) {
      new_number.push_back(texture_sets_before(all, to));
    }
    append_corners(all.corners[to], std::move(from));
  }
  for (Material& look : other.looks) {
    if (look.texture_set < new_number.size()) look.texture_set = new_number[look.texture_set];
  }
  for (CornerAttribute& attribute : all.corners) {
    attribute.of_corner.resize(3 * (triangles + triangles_of_other), kNone);
  }
  std::stable_sort(
      all.corners.begin(), all.corners.end(),
      [](const CornerAttribute& a, const CornerAttribute& b) { return a.kind < b.kind; });
}

// `number_of` has what the other's names become.
void append_labels(TriangleLabels& all, std::size_t triangles, const TriangleLabels& other,
                   std::size_t triangles_of_other, const std::vector<std::uint32_t>& number_of) {
  if (all.empty() && other.empty()) return;
  all.of_triangle.resize(triangles, kNone);
  for (const std::uint32_t label : other.of_triangle) {
    all.of_triangle.push_back(label == kNone ? kNone : number_of[label]);
  }
  all.of_triangle.resize(triangles + triangles_of_other, kNone);
}

std::vector<std::uint32_t> add_names(TriangleLabels& all, const TriangleLabels& other) {
  std::unordered_map<std::string, std::uint32_t> known;
  for (const std::string& name : all.names) {
    known.try_emplace(name, static_cast<std::uint32_t>(known.size()));
  }
  std::vector<std::uint32_t> number_of;
  for (const std::string& name : other.names) {
    const auto [found, is_new] =
        known.try_emplace(name, static_cast<std::uint32_t>(all.names.size()));
    if (is_new) all.names.push_back(name);
    number_of.push_back(found->second);
  }
  return number_of;
}

std::string unused_name(const std::vector<std::string>& names, const std::string& name) {
  for (int i = 2;; ++i) {
    std::string next = name + "_" + std::to_string(i);
    if (std::find(names.begin(), names.end(), next) == names.end()) return next;
  }
}

// Looks of the other have images of `all` by now.
std::vector<std::uint32_t> add_materials(Attributes& all, const Attributes& other) {
  std::vector<std::string>& names = all.materials.names;
  if (!all.looks.empty() || !other.looks.empty()) all.looks.resize(names.size());
  std::vector<std::uint32_t> number_of;
  for (std::size_t m = 0; m < other.materials.names.size(); ++m) {
    const Material look = m < other.looks.size() ? other.looks[m] : Material();
    std::string name = other.materials.names[m];
    auto known = std::find(names.begin(), names.end(), name);
    if (known != names.end() && !all.looks.empty() &&
        !same_look(all, all.looks[static_cast<std::size_t>(known - names.begin())], look)) {
      name = unused_name(names, name);
      known = names.end();
    }
    number_of.push_back(static_cast<std::uint32_t>(known - names.begin()));
    if (known != names.end()) continue;
    names.push_back(std::move(name));
    if (!all.looks.empty() || !other.looks.empty()) all.looks.push_back(look);
  }
  return number_of;
}

}  // namespace

void append_attributes(Attributes& all, std::size_t triangles, Attributes other,
                       std::size_t triangles_of_other) {
  const auto images = static_cast<std::uint32_t>(all.images.size());
  for (Material& look : other.looks) {
    if (look.image != kNone) look.image += images;
  }
  std::move(other.images.begin(), other.images.end(), std::back_inserter(all.images));
  append_all_corners(all, triangles, other, triangles_of_other);
  const auto number_of = add_materials(all, other);
  append_labels(all.materials, triangles, other.materials, triangles_of_other, number_of);
  for (const auto labels : {&Attributes::groups, &Attributes::objects, &Attributes::smoothing}) {
    const auto names = add_names(all.*labels, other.*labels);
    append_labels(all.*labels, triangles, other.*labels, triangles_of_other, names);
  }
  if (all.keepsake && other.keepsake) {
    if (auto joined = all.keepsake->joined(*other.keepsake)) all.keepsake = std::move(joined);
  } else if (other.keepsake) {
    all.keepsake = std::move(other.keepsake);
  }
}

}  // namespace meshrepair
