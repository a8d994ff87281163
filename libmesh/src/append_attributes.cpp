// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>

#include <mesh/attributes.h>

namespace meshrepair {
namespace {

bool same_look(const Attributes& all, const Material& a, const Material& b) {
  if (a.colour != b.colour || a.two_sided != b.two_sided) return false;
  if ((a.image == kNone) != (b.image == kNone)) return false;
  if (a.image == kNone) return true;
  if (a.texture_set != b.texture_set || a.transform != b.transform) return false;
  if (a.sampling != b.sampling) return false;
  const Image &first = all.images[a.image], &second = all.images[b.image];
  if (first.bytes && second.bytes) return *first.bytes == *second.bytes;
  return !first.bytes && !second.bytes && first.path == second.path && first.name == second.name;
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

bool is_colour(const CornerAttribute& attribute) {
  return attribute.kind == CornerAttribute::Kind::colour &&
         (attribute.components == 3 || attribute.components == 4);
}

// Attributes that may be one: the k-th of a kind, a name and a number of components. Colours
// without opacity are opaque.
bool same_set(const CornerAttribute& a, const CornerAttribute& b) {
  return a.kind == b.kind && a.name == b.name &&
         (a.components == b.components || (is_colour(a) && is_colour(b)));
}

void make_components_same(CornerAttribute& a, CornerAttribute& b) {
  if (a.components == b.components) return;
  CornerAttribute& without = a.components < b.components ? a : b;
  std::vector<double> values;
  values.reserve(without.values.size() / 3 * 4);
  for (std::size_t i = 0; i < without.values.size(); i += 3) {
    values.insert(values.end(),
                  {without.values[i], without.values[i + 1], without.values[i + 2], 1});
  }
  without.values = std::move(values);
  without.components = 4;
}

std::uint32_t texture_sets_before(const Attributes& all, std::size_t set) {
  return static_cast<std::uint32_t>(std::count_if(
      all.corners.begin(), all.corners.begin() + static_cast<std::ptrdiff_t>(set),
      [](const CornerAttribute& one) { return one.kind == CornerAttribute::Kind::texture; }));
}

// Returns the numbers that the other's sets of texture coordinates have now; the looks of its
// materials get them.
std::vector<std::uint32_t> append_all_corners(Attributes& all, std::size_t triangles,
                                              Attributes& other, std::size_t triangles_of_other) {
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
    make_components_same(all.corners[to], from);
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
  return new_number;
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
  std::uint32_t number = 0;
  for (const std::string& name : all.names) {
    known.try_emplace(name, number);
    ++number;
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

void append_paints(Attributes& all, std::size_t triangles, const Attributes& other,
                   std::size_t triangles_of_other) {
  const auto find = [](std::vector<TrianglePaint>& paints, const std::string& name) {
    return std::find_if(paints.begin(), paints.end(),
                        [&](const TrianglePaint& one) { return one.name == name; });
  };
  for (const TrianglePaint& paint : other.paints) {
    if (find(all.paints, paint.name) == all.paints.end()) all.paints.push_back({paint.name, {}});
    TriangleLabels& codes = find(all.paints, paint.name)->codes;
    const auto numbers = add_names(codes, paint.codes);
    append_labels(codes, triangles, paint.codes, triangles_of_other, numbers);
  }
  for (TrianglePaint& paint : all.paints) {
    paint.codes.of_triangle.resize(triangles + triangles_of_other, kNone);
  }
}

Material look_of(const Attributes& attributes, std::size_t material) {
  return material < attributes.looks.size() ? attributes.looks[material] : Material();
}

// What materials of the other one are called from now on.
std::vector<std::string> names_of_other(AppendedMaterials& materials) {
  const auto& [names, of_triangle] = materials.all.materials;
  const bool has_looks = !materials.all.looks.empty() || !materials.other.looks.empty();
  // Looks of the one alone are not known of the other.
  const bool are_alike = materials.all.looks.empty() == materials.other.looks.empty();
  std::vector<std::string> result;
  for (std::size_t m = 0; m < materials.other.materials.names.size(); ++m) {
    const std::string& name = materials.other.materials.names[m];
    const auto renamed = materials.new_names.find(name);
    const auto known = std::find(names.begin(), names.end(), name);
    const auto number = static_cast<std::size_t>(known - names.begin());
    const bool is_other = known != names.end() && has_looks &&
                          (!are_alike || !same_look(materials.all, look_of(materials.all, number),
                                                    look_of(materials.other, m)));
    if (renamed != materials.new_names.end()) {
      result.push_back(renamed->second);
    } else {
      result.push_back(is_other ? materials.free_name(name) : name);
    }
  }
  return result;
}

// What becomes of both keepsakes.
void append_keepsake(Attributes& all, const Attributes& other, AppendedMaterials& materials) {
  if (!other.keepsake) return;
  if (auto both = other.keepsake->appended_to(all.keepsake.get(), materials)) {
    all.keepsake = std::move(both);
  } else if (!all.keepsake) {
    all.keepsake = other.keepsake;
  }
}

std::vector<std::uint32_t> add_materials(Attributes& all, const Attributes& other,
                                         const std::vector<std::string>& new_names) {
  const bool has_looks = !all.looks.empty() || !other.looks.empty();
  TriangleLabels renamed;
  renamed.names = new_names;
  if (has_looks) all.looks.resize(all.materials.names.size());
  std::vector<std::uint32_t> number_of = add_names(all.materials, renamed);
  if (!has_looks) return number_of;
  const std::size_t before = all.looks.size();
  all.looks.resize(all.materials.names.size());
  for (std::size_t m = 0; m < number_of.size(); ++m) {
    if (number_of[m] >= before) all.looks[number_of[m]] = look_of(other, m);
  }
  return number_of;
}

}  // namespace

AppendedMaterials::AppendedMaterials(const Attributes& all_before, const Attributes& appended)
    : all(all_before),
      other(appended),
      own_(all.materials.names.begin(), all.materials.names.end()),
      taken_(own_) {
  taken_.insert(other.materials.names.begin(), other.materials.names.end());
}

std::string AppendedMaterials::free_name(const std::string& name) {
  if (!own_.contains(name)) return name;
  for (int i = 2;; ++i) {
    std::string next = name + "_" + std::to_string(i);
    if (taken_.insert(next).second) return next;
  }
}

void AppendedMaterials::take_name(const std::string& name) {
  own_.insert(name);
  taken_.insert(name);
}

void append_attributes(Attributes& all, std::size_t triangles, Attributes other,
                       std::size_t triangles_of_other) {
  const auto images = static_cast<std::uint32_t>(all.images.size());
  for (Material& look : other.looks) {
    if (look.image != kNone) look.image += images;
  }
  std::move(other.images.begin(), other.images.end(), std::back_inserter(all.images));
  auto texture_sets = append_all_corners(all, triangles, other, triangles_of_other);
  AppendedMaterials materials(all, other);
  materials.texture_sets = std::move(texture_sets);
  append_keepsake(all, other, materials);
  const auto number_of = add_materials(all, other, names_of_other(materials));
  append_labels(all.materials, triangles, other.materials, triangles_of_other, number_of);
  for (const auto labels : {&Attributes::groups, &Attributes::objects, &Attributes::smoothing}) {
    const auto names = add_names(all.*labels, other.*labels);
    append_labels(all.*labels, triangles, other.*labels, triangles_of_other, names);
  }
  append_paints(all, triangles, other, triangles_of_other);
  if (all.filaments.empty()) all.filaments = std::move(other.filaments);
}

}  // namespace meshrepair
