// SPDX-License-Identifier: MIT
// What is written is read by lib3mf, the library of those who make the format.
#include "threemf_peer.h"

#include <string>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "each_seed.h"
#include "threemf_soups.h"

namespace meshrepair {
namespace {

TEST(ThreemfPeer, ReadsTheSameTriangles) {
  const TriangleSoup soup = proper_grid(20);
  expect_read_by_peer(format_soup(soup, SoupFormat::threemf, {{"a comment & more"}}), soup);
}

std::string write_textured(const ThreemfSoup& textured) {
  return format_soup(textured.soup, SoupFormat::threemf, {.attributes = &textured.attributes});
}

TEST(ThreemfPeer, ReadsMaterialsAndTexturesStrictly) {
  for_each_seed(20, [&](std::uint64_t seed) {
    ThreemfSoup textured = random_threemf_soup(seed);
    textured.attributes.corners.pop_back();
    textured.attributes.looks[3].image = kNone;  // nothing needs layers
    expect_read_by_peer(write_textured(textured), textured.soup);
  });
}

TEST(ThreemfPeer, ReadsColoursStrictly) {
  ThreemfSoup textured = random_threemf_soup(3);
  textured.attributes.corners.erase(textured.attributes.corners.begin());
  textured.attributes.materials = {};
  expect_read_by_peer(write_textured(textured), textured.soup);
}

// Of layers this version of lib3mf knows nothing, and passes over them.
TEST(ThreemfPeer, ReadsTrianglesWithLayersOfProperties) {
  for_each_seed(20, [&](std::uint64_t seed) {
    const ThreemfSoup textured = random_threemf_soup(seed);
    expect_read_by_peer(write_textured(textured), textured.soup, false);
  });
}

}  // namespace
}  // namespace meshrepair
