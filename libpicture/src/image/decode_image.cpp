#include <base/error.h>
#include <picture/decode_image.h>

#include "image/jpeg_reader.h"
#include "image/png_reader.h"

namespace meshrepair {

Pixels decode_image(std::string_view bytes, std::size_t most_pixels) {
  if (begins_with_png(bytes)) return read_png(bytes, most_pixels);
  if (begins_with_jpeg(bytes)) return read_jpeg(bytes, most_pixels);
  throw InputError("is neither PNG nor JPEG");
}

}  // namespace meshrepair
