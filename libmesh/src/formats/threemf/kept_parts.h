// SPDX-License-Identifier: MIT
// What a 3MF package holds besides meshes and what they look like, for packages that are written.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include <mesh/attributes.h>
#include <mesh/mesh_source.h>

#include "formats/common/zip_reader.h"
#include "model_instances.h"
#include "model_part.h"
#include "package_parts.h"
#include "project/project_config.h"

namespace meshrepair {

struct KeptPackage final : Keepsake {
  struct Part {
    std::string name;
    std::string media_type;  // may be empty
    std::shared_ptr<const std::string> bytes;
  };
  // How pictures were laid over triangles, as the file had it.
  struct Tiling {
    std::shared_ptr<const std::string> picture;
    std::string u, v, filter;

    [[nodiscard]] TextureSampling sampling() const;
  };

  // Of the parts, one that names objects and triangles.
  struct Config {
    std::string name;
    std::shared_ptr<const ProjectConfig> text;
  };

  std::optional<LengthUnit> unit;
  std::optional<KeptGraph> graph;  // of the scene, if meshes were read one by one
  std::vector<ModelNamespace> namespaces;
  std::vector<ModelMetadata> metadata;
  std::vector<Part> parts;
  std::vector<Config> configs;                            // only with a graph
  std::vector<PackageRelationship> of_package, of_model;  // to these parts
  std::vector<Tiling> tilings;

  [[nodiscard]] std::vector<std::string> lost_in(SoupFormat format) const override;
  // The first package, with the pictures of this one, and its parts that something refers to: what
  // is known by its name alone there can be only one of, and of thumbnails, too.
  [[nodiscard]] std::shared_ptr<const Keepsake> appended_to(
      const Keepsake* first, AppendedMaterials& materials) const override;

 private:
  [[nodiscard]] std::shared_ptr<KeptPackage> copy() const;
};

// Reads all parts but those that are written anew: models, relationships, types of content and the
// parts in `taken` (by part_key()). Left out, with a warning for each, is what belongs to the
// meshes as they were: toolpaths and what was found with them, signatures; and where there is no
// graph, what slicers say of objects by their ids or their order. `model` is the name of the first
// model.
void keep_parts(const MeshSource& source, ZipReader& archive, const ContentTypes& types,
                const std::string& model, const std::unordered_set<std::string>& taken,
                KeptPackage& kept, ReadReport& report);

}  // namespace meshrepair
