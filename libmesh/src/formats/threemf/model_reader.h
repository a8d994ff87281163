// SPDX-License-Identifier: MIT
// Reads a 3D model part of a 3MF package.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "beam_lattice.h"
#include "common/xml_stream.h"
#include "model_part.h"

namespace meshrepair {

// Takes the elements of a part one by one. What it does not know it passes over, with all that is
// inside.
class ModelReader final : public XmlHandler {
 public:
  // The number of a part that a component or an item names.
  using PartNumber = std::function<std::uint32_t(std::string_view path)>;

  // `number` is that of the part itself. Properties are read if asked for; beams are bodies of so
  // many sides.
  ModelReader(ModelPart& part, ModelOddities& oddities, std::uint32_t number, PartNumber number_of,
              bool properties, std::size_t beam_sides);
  // Where its messages say it is. To be called before anything else.
  void attach(const XmlStream& stream) { stream_ = &stream; }

  void start(std::string_view space, std::string_view name,
             const XmlAttributes& attributes) override;
  void end() override;
  void text(std::string_view piece) override;
  void declare(std::string_view prefix, std::string_view space) override;

  // To be called at the end.
  [[nodiscard]] bool saw_model() const { return saw_model_; }

  enum class Element : std::uint8_t;

 private:
  void open(Element element, const XmlAttributes& attributes);
  void open_property(Element element, const XmlAttributes& attributes);
  void read_model(const XmlAttributes& attributes);
  void read_object(const XmlAttributes& attributes);
  void read_vertex(const XmlAttributes& attributes);
  void read_triangle(const XmlAttributes& attributes);
  void read_reference(const XmlAttributes& attributes, std::vector<ObjectReference>& references);
  void read_layers(const XmlAttributes& attributes);
  void read_layer_entries(const XmlAttributes& attributes);
  void add_group(PropertyGroup::Kind kind, const XmlAttributes& attributes);
  void add_colour(std::string_view text);
  void add_range(std::uint32_t first, std::uint32_t last);
  bool add_paint(std::string_view name, std::string_view value, PropertyUse& property);
  void end_mesh();
  void end_lattice();
  void end_group(bool is_of_item);

  [[nodiscard]] bool is_in_group() const;
  [[nodiscard]] std::vector<ModelMetadata>& metadata();
  [[nodiscard]] std::string space_of_prefix(std::string_view name) const;
  [[nodiscard]] ModelObject& object() { return part_.objects.back(); }
  [[nodiscard]] PropertyGroup& group() { return part_.groups.back(); }

  ModelPart& part_;
  ModelOddities& oddities_;
  std::uint32_t number_;
  PartNumber number_of_;
  bool properties_;
  std::size_t beam_sides_;
  BeamLattice lattice_;  // of the mesh that is read
  const XmlStream* stream_ = nullptr;
  std::vector<Element> open_;
  std::vector<ModelMetadata> metadata_of_group_;
  std::unordered_map<std::string, std::uint32_t> number_of_code_;
  bool saw_model_ = false;
};

}  // namespace meshrepair
