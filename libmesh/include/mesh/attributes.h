// SPDX-License-Identifier: MIT
// What triangles carry besides the places of their corners: texture coordinates, normals, colours,
// materials, groups.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <base/ids.h>
#include <mesh/soup.h>

namespace meshrepair {

enum class SoupFormat;

// One value for each corner of each triangle. Corners share values by number, so that seams show:
// there two triangles have different numbers at one point.
struct CornerAttribute {
  enum class Kind {
    texture,  // coordinates in a texture, two or three; v grows upwards
    normal,   // of length 1
    tangent,  // of length 1, and a fourth number that is the sign of the bitangent
    colour,   // red, green, blue, and perhaps opacity, from 0 to 1
    other,    // any numbers, which `name` tells apart; morph targets, too: see skins.h
    skin,     // numbers of joints, and weights, that no one may mix but SkinMixer
  };
  // What files can have values for. Writers do the same where their format can, as long as it says
  // all.
  enum class Place { corner, point, triangle };
  // As what the file held the values: others would not hold them bit for bit. A byte is a share of
  // 255.
  enum class Storage { real64, real32, byte, integer };

  Kind kind = Kind::texture;
  std::string name;  // of the set, where the file has one
  Place place = Place::corner;
  Storage storage = Storage::real64;
  std::size_t components = 2;
  std::vector<double> values;            // one after the other, `components` each
  std::vector<std::uint32_t> of_corner;  // of corner k of triangle t at 3 t + k; kNone: it has none

  [[nodiscard]] std::size_t count() const { return values.size() / components; }
};

// A name for each triangle, or none.
struct TriangleLabels {
  std::vector<std::string> names;
  std::vector<std::uint32_t> of_triangle;  // kNone: without; empty: all are without

  [[nodiscard]] bool empty() const { return of_triangle.empty(); }
};

// What one of a slicer's brushes left on triangles.
struct TrianglePaint {
  std::string name;      // of the attribute of 3MF: "paint_color", "slic3rpe:mmu_segmentation", ...
  TriangleLabels codes;  // see triangle_paint.h; may be no code at all
};

// A picture. Readers and writers of meshes never look into it.
struct Image {
  // Of the file, without folders; as whoever names it has it where it is not to be followed; may be
  // empty.
  std::string name;
  std::string media_type;  // "image/png"; may be empty
  std::string path;  // of the file, as this process finds it; empty: none, or not to be followed
  std::shared_ptr<const std::string> bytes;  // if it is none
  bool is_elsewhere = false;  // a link at the path leads to where names may not: not to be opened
};

// Scales coordinates in a texture, turns them by an angle in radians, and moves them, in this
// order; with v downwards, as KHR_texture_transform of glTF has it.
struct TextureTransform {
  std::array<double, 2> offset = {0, 0}, scale = {1, 1};
  double rotation = 0;

  bool operator==(const TextureTransform&) const = default;
};

// What a picture is beyond its edges, and between its pixels.
struct TextureSampling {
  enum class Wrap { repeat, mirror, clamp, none };  // none: there is nothing of it
  enum class Filter { automatic, linear, nearest };

  std::array<Wrap, 2> wrap = {Wrap::repeat, Wrap::repeat};  // beside it, and above and below
  Filter filter = Filter::automatic;

  bool operator==(const TextureSampling&) const = default;
};

// What all formats that have materials can say of one.
struct Material {
  std::array<double, 4> colour = {1, 1, 1, 1};  // red, green, blue as sRGB has them, and opacity
  std::uint32_t image = kNone;                  // of Attributes::images: times the colour
  std::uint32_t texture_set = 0;    // of the attributes with texture coordinates: that of the image
  TextureTransform transform = {};  // of these coordinates
  TextureSampling sampling = {};    // of the image
  bool two_sided = false;           // seen also from behind, where a format can say so
};

struct AppendedMaterials;

// What else a file held and another of its format can hold again. Its reader and writer alone know
// what it is.
struct Keepsake {
  Keepsake() = default;
  Keepsake(const Keepsake&) = delete;
  Keepsake& operator=(const Keepsake&) = delete;
  virtual ~Keepsake() = default;

  // Words on what no file of another format can hold of it.
  [[nodiscard]] virtual std::vector<std::string> lost_in(SoupFormat format) const;

  // The same where attributes with this one are appended to those with `first` (may be null). It
  // says what materials are to be called where it knows more of them than how they look. Null:
  // `first` alone; or this one, unchanged, if there is no first.
  [[nodiscard]] virtual std::shared_ptr<const Keepsake> appended_to(
      const Keepsake* first, AppendedMaterials& materials) const;
};

// Of a soup, not owned: all lists have an entry for each of its triangles or corners, or are empty.
struct Attributes {
  std::vector<CornerAttribute> corners;  // in the order of the kinds; of one kind as in the file
  TriangleLabels materials;
  std::vector<Material> looks;  // of the materials, in their order; empty: not known
  std::vector<Image> images;
  TriangleLabels groups;
  TriangleLabels objects;
  TriangleLabels smoothing;
  std::vector<TrianglePaint> paints;  // of different names
  std::vector<std::array<double, 4>>
      filaments;                             // their colours, as Material has one; not all known
  std::shared_ptr<const Keepsake> keepsake;  // may be null

  // No triangle carries anything.
  [[nodiscard]] bool is_bare() const {
    return corners.empty() && materials.empty() && groups.empty() && objects.empty() &&
           smoothing.empty() && paints.empty();
  }
  [[nodiscard]] bool empty() const { return is_bare() && !keepsake; }
};

// While attributes are appended to others: how their materials are named.
struct AppendedMaterials {
  AppendedMaterials(const Attributes& all, const Attributes& other);

  // The name itself, or with a number that no material has if `all` has it already.
  [[nodiscard]] std::string free_name(const std::string& name);
  // No free name is this one, as keepsakes know it.
  void take_name(const std::string& name);

  const Attributes& all;                    // it has the images of both, and its own materials
  const Attributes& other;                  // the images of its looks are those of `all`
  std::vector<std::uint32_t> texture_sets;  // numbers in `all` of the sets of `other`
  std::unordered_map<std::string, std::string> new_names;  // of materials of `other`

 private:
  std::unordered_set<std::string> own_, taken_;
};

// The first of a kind, or null.
[[nodiscard]] const CornerAttribute* find_kind(const Attributes& attributes,
                                               CornerAttribute::Kind kind);

// Appends those of another soup, whose triangles come behind the so many that are there. Materials
// of one name that look different, or of which files say different things, get different names; of
// kinds that one of both lacks, corners have no value there.
void append_attributes(Attributes& all, std::size_t triangles, Attributes other,
                       std::size_t triangles_of_other);

// Makes values that are equal bit for bit one, and drops those that no corner has; the others keep
// their order. Linear; on several threads.
void share_values(CornerAttribute& attribute);

// Of each point the one value that all its corners have, or kNone; nothing where corners of one
// point have different ones.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> values_by_point(
    const TriangleSoup& soup, const CornerAttribute& attribute);

// The same of the first of its corners that has one, whatever the others have.
[[nodiscard]] std::vector<std::uint32_t> first_values_by_point(const TriangleSoup& soup,
                                                               const CornerAttribute& attribute);

// Of each triangle the one value that all its corners have, or kNone; nothing where some have
// different ones.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> values_by_triangle(
    const CornerAttribute& attribute);

}  // namespace meshrepair
