// SPDX-License-Identifier: MIT
#include "report/attribute_report.h"

#include <array>
#include <string_view>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <mesh/lost_attributes.h>
#include <mesh/seams.h>

#include "report/words.h"

namespace meshrepair {
namespace {

using Kind = CornerAttribute::Kind;

std::string_view kind_name(Kind kind) {
  constexpr std::array<std::string_view, 6> kNames = {"texture", "normal", "tangent",
                                                      "colour",  "other",  "skin"};
  return kNames[static_cast<std::size_t>(kind)];
}

using NamedLabels = std::pair<std::string_view, const TriangleLabels*>;

std::array<NamedLabels, 4> all_labels(const Attributes& attributes) {
  return {{{"material", &attributes.materials},
           {"group", &attributes.groups},
           {"object", &attributes.objects},
           {"smoothing group", &attributes.smoothing}}};
}

}  // namespace

std::vector<std::string> attribute_words(const TriangleSoup& soup, const Attributes& attributes) {
  std::vector<std::string> words;
  for (const CornerAttribute& attribute : attributes.corners) {
    std::string text = kind_words(attribute);
    if (attribute.kind == Kind::texture) {
      text += fmt::format(" ({})", number_of(count_seams(soup, attribute), "edge") + " of seams");
    }
    words.push_back(std::move(text));
  }
  for (const auto& [name, labels] : all_labels(attributes)) {
    if (!labels->empty()) words.push_back(number_of(labels->names.size(), name));
  }
  for (const TrianglePaint& paint : attributes.paints) words.push_back("'" + paint.name + "'");
  if (!attributes.images.empty()) words.push_back(number_of(attributes.images.size(), "picture"));
  return words;
}

std::string lost_words(const TriangleSoup& soup, const Attributes& all, const Attributes& held,
                       SoupFormat format) {
  std::vector<std::string> lost = lost_attributes(soup, all, held, format);
  for (std::string& words : lost) {
    if (words == "objects" && has_instances(format)) words += " (--scene each keeps them)";
    if (words == "groups" && format == SoupFormat::stl_binary) {
      words += " (--format stl-ascii keeps them)";
    }
  }
  return fmt::format("{}", fmt::join(lost, ", "));
}

Json attributes_section(const TriangleSoup& soup, const Attributes& attributes) {
  Json corners = Json::array();
  for (const CornerAttribute& attribute : attributes.corners) {
    corners.push_back({{"kind", kind_name(attribute.kind)},
                       {"name", attribute.name},
                       {"components", attribute.components},
                       {"values", attribute.count()},
                       {"seam_edges", count_seams(soup, attribute)}});
  }
  return {{"corners", corners},
          {"materials", attributes.materials.names},
          {"groups", attributes.groups.names},
          {"objects", attributes.objects.names},
          {"smoothing_groups", attributes.smoothing.names},
          {"pictures", attributes.images.size()}};
}

}  // namespace meshrepair
