// SPDX-License-Identifier: MIT
// The reader of .bsp files, and what the programs do with a tree that it lets pass.
//
// The sections carry checksums, which no mutation of bytes hits. So a mutation here is one of the
// items of a section, after which its count and its checksum are mended; now and then it is one of
// the bytes as they are.
#include <cstdint>
#include <string>
#include <string_view>

#include <base/error.h>
#include <bsp/tree_io.h>
#include <extract/build_cells.h>
#include <repair/repair.h>

#include "cells/check_complex.h"
#include "fuzz_input.h"
#include "require_surface.h"
#include "tree_bytes.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace meshrepair::testing {
namespace {

// Larger trees are read, but not labelled.
constexpr std::size_t kMostNodes = 120;
constexpr std::size_t kMostTriangles = 60;

// What input may come to.
template <class Work>
void run_or_refuse(Work work) {
  try {
    work();
  } catch (const InputError& error) {
    require(std::string_view(error.what()).find('\n') == std::string_view::npos,
            "a refusal has several lines");
  } catch (const NoSolidError&) {
    // Labels may be any.
  }
}

void check_cells_of(const Tree& tree) {
  ClipReport report;
  const CellComplex complex = build_cells(tree, {.check_every_clip = true}, report);
  internal::check_complex(complex);
  require(complex.cells.size() == tree.leaves.size(), "there is not one cell for each leaf");
  require(report.fallbacks() == 0, "a tree that is not valid was taken");
}

void check_extracting(const Tree& tree, const RepairOptions& options) {
  RepairReport report;
  const Surface surface = extract_mesh(tree, options, report);
  const SurfaceCheck check = check_surface(surface.mesh);
  require_closed_manifold(check);
  if (report.certify.passed()) require_valid_solid(check);
}

void check_labelling(Tree tree, const RepairOptions& options) {
  RepairReport report;
  label_tree(tree, options, report);
  check_extracting(parse_tree(format_tree(tree), "labelled"), options);
}

void check_tree(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  Tree tree = parse_tree(bytes, "any.bsp");
  require(format_tree(tree) == bytes, "a tree comes back as other bytes");
  if (tree.nodes.size() > kMostNodes || tree.input.triangles.size() > kMostTriangles) return;
  run_or_refuse([&] { check_cells_of(tree); });
  RepairOptions options;
  options.inside.rule = static_cast<InsideRule>(bytes.size() / 4 % 4);
  run_or_refuse([&] { check_extracting(tree, options); });
  run_or_refuse([&] { check_labelling(std::move(tree), options); });
}

// Sections as far as they lie within the bytes.
std::vector<Section> whole_sections(std::string_view bytes) {
  std::vector<Section> sections;
  std::size_t at = kHeaderBytes;
  while (at + kSectionHeaderBytes <= bytes.size()) {
    Section s;
    s.header = at;
    s.begin = at + kSectionHeaderBytes;
    const auto item = number_at<std::uint32_t>(bytes, at + 4);
    const auto items = number_at<std::uint64_t>(bytes, at + 8);
    if (item == 0 || items > (bytes.size() - s.begin) / item) break;
    s.end = s.begin + item * static_cast<std::size_t>(items);
    sections.push_back(s);
    at = s.end;
  }
  return sections;
}

// The items of one section mutated, cut to whole ones.
void mutate_section(std::string& bytes, const Section& s, std::size_t most) {
  const std::size_t others = bytes.size() - (s.end - s.begin);
  std::string items = bytes.substr(s.begin, s.end - s.begin);
  const std::size_t size = items.size();
  items.resize(most - others);
  const auto item = number_at<std::uint32_t>(bytes, s.header + 4);
  items.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(items.data()), size, items.size()) /
               item * item);
  bytes.replace(s.begin, size, items);
  put_at(bytes, s.header + 8, static_cast<std::uint64_t>(items.size() / item));
}

std::size_t mutate(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  const std::vector<Section> sections = whole_sections(bytes);
  // One in sixteen is of the bytes as they are, half of these without mending.
  if (sections.empty() || seed % 16 == 0) {
    bytes.resize(std::max(most, size));
    bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, most));
  } else if (most >= size) {
    mutate_section(bytes, sections[seed / 16 % sections.size()], most);
  }
  if (seed % 32 != 0) {
    for (const Section& s : whole_sections(bytes)) mend_checksum(bytes, s);
  }
  std::memcpy(data, bytes.data(), bytes.size());
  return bytes.size();
}

}  // namespace
}  // namespace meshrepair::testing

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  return meshrepair::testing::mutate(data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace meshrepair::testing;
  run_or_refuse([&] { check_tree(data, size); });
  return 0;
}
