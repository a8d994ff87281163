// What a command line says of a picture.
#pragma once

#include <string>

#include <picture/pixels.h>
#include <picture/view.h>

namespace meshrepair {

struct PictureRequest {
  std::string path;  // empty: none is asked for
  PictureSize size;  // of each mesh
  View view;

  [[nodiscard]] bool wanted() const { return !path.empty(); }
};

}  // namespace meshrepair
