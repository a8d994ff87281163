// SPDX-License-Identifier: MIT
// How the parts of a package hang together: its relationships and its types of content.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <mesh/mesh_source.h>

#include "formats/common/zip_reader.h"

namespace meshrepair {

inline constexpr std::string_view kModelRelationship =
    "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
inline constexpr std::string_view kTextureRelationship =
    "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dtexture";
inline constexpr std::string_view kThumbnailRelationship =
    "http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail";
inline constexpr std::string_view kModelType =
    "application/vnd.ms-package.3dmanufacturing-3dmodel+xml";
inline constexpr std::string_view kRelationshipsType =
    "application/vnd.openxmlformats-package.relationships+xml";
inline constexpr std::string_view kContentTypesPart = "[Content_Types].xml";
inline constexpr std::string_view kRootRelationships = "_rels/.rels";
inline constexpr std::string_view kUsualModelPart = "3D/3dmodel.model";

struct PackageRelationship {
  std::string type;
  std::string target;  // as part_name() makes it
};

// Those of a part, or of the package if the name is empty; none where it has none. Throws
// InputError where they cannot be read.
[[nodiscard]] std::vector<PackageRelationship> read_relationships(const MeshSource& source,
                                                                  ZipReader& archive,
                                                                  std::string_view part);

class ContentTypes {
 public:
  // Throws InputError where they cannot be read. None where the package has none.
  void read(const MeshSource& source, ZipReader& archive);

  // Empty if it is not known.
  [[nodiscard]] std::string of(std::string_view part) const;

 private:
  std::unordered_map<std::string, std::string> of_extension_, of_part_;  // by part_key()
};

}  // namespace meshrepair
