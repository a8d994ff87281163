// SPDX-License-Identifier: MIT
// The parts of a package that say how the others hang together.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "kept_parts.h"
#include "written_properties.h"

namespace meshrepair {

// As types of content, relationships and attributes name a part.
[[nodiscard]] std::string uri_of_part(std::string_view part);

// The types of content, and the relationships of the package and of the model.
class PackageWriter {
 public:
  // `kept` may be null. Both have to stay.
  PackageWriter(const KeptPackage* kept, const std::vector<WrittenPicture>& pictures)
      : kept_(kept), pictures_(pictures) {}

  [[nodiscard]] std::string content_types() const;
  [[nodiscard]] std::string of_package();
  // Empty if there are none. Thumbnails of objects are among them.
  [[nodiscard]] std::string of_model(const std::vector<std::string>& thumbnails);

 private:
  void begin();
  void add(std::string_view type, std::string_view target);
  [[nodiscard]] std::string end();

  const KeptPackage* kept_;
  const std::vector<WrittenPicture>& pictures_;
  std::string xml_;
  std::size_t next_ = 0;
};

}  // namespace meshrepair
