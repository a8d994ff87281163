// SPDX-License-Identifier: MIT
// The header of a PCD file (Point Cloud Library).
//
//   # .PCD v0.7 - Point Cloud Data file format
//   VERSION 0.7
//   FIELDS x y z rgb          names, one for each field
//   SIZE 4 4 4 4              bytes of one value
//   TYPE F F F U              F floating point, I signed, U unsigned
//   COUNT 1 1 1 1             values; may be left out
//   WIDTH 640
//   HEIGHT 480
//   VIEWPOINT 0 0 0 1 0 0 0   may be left out
//   POINTS 307200             may be left out: WIDTH times HEIGHT
//   DATA ascii|binary|binary_compressed
//
// Ascii data has a point on each line, binary data one record after the other, the fields in order.
// Compressed data begins with two 32-bit sizes, compressed and not; what comes out of the LZF
// stream holds first all values of the first field, then all of the second, and so on.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <mesh/mesh_source.h>

#include "formats/common/value_type.h"

namespace meshrepair {

enum class PcdEncoding { ascii, binary, compressed };

struct PcdField {
  std::string name;
  ValueType type = ValueType::float32;
  std::size_t size = 4;   // of one value, in bytes
  std::size_t count = 1;  // of values
  std::size_t at = 0;     // position in a record

  [[nodiscard]] std::size_t bytes() const { return size * count; }
};

struct PcdHeader {
  PcdEncoding encoding = PcdEncoding::ascii;
  std::vector<PcdField> fields;
  std::size_t record = 0;    // bytes of a point
  std::uint64_t points = 0;  // as declared: not to be trusted
  std::size_t data_at = 0;
};

// Throws InputError, with the line, for a header that cannot be understood or has no end.
[[nodiscard]] PcdHeader read_pcd_header(const MeshSource& source);

}  // namespace meshrepair
