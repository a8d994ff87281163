// SPDX-License-Identifier: MIT
// The .bsp file: a tree with everything that labelling and extracting need.
//
// Layout, all numbers little-endian, no padding:
//
//   8 bytes   signature 42 53 50 0D 0A 1A 0A 00 ("BSP", then bytes that text-mode transfers damage)
//   u32       version, 1; a reader refuses every other
//   u32       number of sections, 7
// then each section, in this order:
//   4 bytes   name
//   u32       bytes of one item
//   u64       number of items
//   u64       checksum of the items' bytes (64-bit FNV-1a over 8-byte words, the last filled up
//   with zeros) items
//
//   "GRID"  1 item    f64 origin x, y, z; f64 unit
//   "PNTS"  points    f64 original x, y, z; i32 grid x, y, z, what the original is rounded to
//   "TRIS"  triangles u32 corners a, b, c; u32 plane; i32 winding times layers; u32 source
//   "PLNS"  planes    i64 normal x, y, z; u64 offset low word, i64 offset high word
//   "NODE"  nodes     u32 plane; u32 positive child, u32 negative child (top bit: a leaf);
//                     u32 first triangle; u32 number of triangles
//   "NTRI"  triangles at nodes, u32
//   "LEAF"  leaves    u32 label (0 unknown, 1 empty, 2 solid); f32 confidence
//
// The root is node 0, or leaf 0 where there are no nodes. Item sizes are fixed by the version.
// Limits: 2^31 of each kind. Rejected: offsets to sections (one more number to lie),
// variable-length integers (the planes' coefficients fill their words), text (four times the size).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <base/progress.h>
#include <bsp/tree.h>
#include <mesh/soup_io.h>

namespace meshrepair {

// The bytes of the file. The same tree gives the same bytes.
[[nodiscard]] std::string format_tree(const Tree& tree);

// The tree of a file's bytes; `name` is used in messages. Trusts nothing: counts are held against
// the bytes that are there, every index and every invariant of the structure is checked. Throws
// InputError naming the section, LimitError.
[[nodiscard]] Tree parse_tree(std::string_view bytes, const std::string& name,
                              const ReadOptions& options = {});

// Files; "-" is standard output or input. Throw OutputError, InputError, LimitError. `progress` is
// asked while the bytes are written whether to go on.
void write_tree(const Tree& tree, const std::filesystem::path& path,
                ProgressObserver* progress = nullptr);
[[nodiscard]] Tree read_tree(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace meshrepair
