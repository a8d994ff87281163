// What is written is read by lib3mf, the library of those who make the format.
#include <Model/COM/NMR_DLLInterfaces.h>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "soup_fixtures.h"
#include "threemf_soups.h"

// lib3mf 1.8 forgets some of its memory.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#include <sanitizer/lsan_interface.h>
#define MESHREPAIR_IGNORE_LEAKS const __lsan::ScopedDisabler ignore_leaks
#endif
#endif
#ifndef MESHREPAIR_IGNORE_LEAKS
#define MESHREPAIR_IGNORE_LEAKS static_assert(true)
#endif

namespace meshrepair {
namespace {

struct ReleasePeer {
  void operator()(void** object) const { NMR::lib3mf_release(object); }
};
using Peer = std::unique_ptr<void*, ReleasePeer>;

struct PeerModel {
  std::vector<std::array<float, 3>> points;
  std::vector<Triangle> triangles;
  std::size_t objects = 0;
  std::string warnings;
};

void read_mesh(void** mesh, PeerModel& model) {
  DWORD points = 0, triangles = 0;
  ASSERT_EQ(NMR::lib3mf_meshobject_getvertexcount(mesh, &points), LIB3MF_OK);
  ASSERT_EQ(NMR::lib3mf_meshobject_gettrianglecount(mesh, &triangles), LIB3MF_OK);
  for (DWORD i = 0; i < points; ++i) {
    NMR::MODELMESHVERTEX v;
    ASSERT_EQ(NMR::lib3mf_meshobject_getvertex(mesh, i, &v), LIB3MF_OK);
    model.points.push_back({v.m_fPosition[0], v.m_fPosition[1], v.m_fPosition[2]});
  }
  for (DWORD i = 0; i < triangles; ++i) {
    NMR::MODELMESHTRIANGLE t;
    ASSERT_EQ(NMR::lib3mf_meshobject_gettriangle(mesh, i, &t), LIB3MF_OK);
    model.triangles.push_back({t.m_nIndices[0], t.m_nIndices[1], t.m_nIndices[2]});
  }
}

PeerModel read_by_peer(std::string bytes, bool strict = true) {
  MESHREPAIR_IGNORE_LEAKS;
  PeerModel result;
  void** made = nullptr;
  EXPECT_EQ(NMR::lib3mf_createmodel(&made), LIB3MF_OK);
  const Peer model(made);
  EXPECT_EQ(NMR::lib3mf_model_queryreader(model.get(), "3mf", &made), LIB3MF_OK);
  const Peer reader(made);
  EXPECT_EQ(NMR::lib3mf_reader_setstrictmodeactive(reader.get(), strict), LIB3MF_OK);
  const auto read = NMR::lib3mf_reader_readfrombuffer(
      reader.get(), reinterpret_cast<BYTE*>(bytes.data()), bytes.size());
  if (read != LIB3MF_OK) {
    DWORD code = 0;
    LPCSTR text = nullptr;
    NMR::lib3mf_getlasterror(reader.get(), &code, &text);
    ADD_FAILURE() << "lib3mf: " << (text == nullptr ? "?" : text);
    return result;
  }
  EXPECT_EQ(NMR::lib3mf_model_getmeshobjects(model.get(), &made), LIB3MF_OK);
  const Peer objects(made);
  int has_next = 0;
  while (NMR::lib3mf_resourceiterator_movenext(objects.get(), &has_next) == LIB3MF_OK &&
         has_next != 0) {
    EXPECT_EQ(NMR::lib3mf_resourceiterator_getcurrent(objects.get(), &made), LIB3MF_OK);
    const Peer mesh(made);
    read_mesh(mesh.get(), result);
    ++result.objects;
  }
  return result;
}

void expect_same(const PeerModel& peer, const TriangleSoup& soup) {
  EXPECT_EQ(peer.objects, 1u);
  EXPECT_EQ(peer.triangles, soup.triangles);
  ASSERT_EQ(peer.points.size(), soup.points.size());
  for (std::size_t p = 0; p < soup.points.size(); ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(peer.points[p][i], static_cast<float>(soup.points[p][static_cast<int>(i)]));
    }
  }
}

TEST(ThreemfPeer, ReadsTheSameTriangles) {
  const TriangleSoup soup = proper_grid(20);
  expect_same(read_by_peer(format_soup(soup, SoupFormat::threemf, {{"a comment & more"}})), soup);
}

std::string write_textured(const ThreemfSoup& textured) {
  return format_soup(textured.soup, SoupFormat::threemf, {.attributes = &textured.attributes});
}

TEST(ThreemfPeer, ReadsMaterialsAndTexturesStrictly) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    ThreemfSoup textured = random_threemf_soup(seed);
    textured.attributes.corners.pop_back();
    textured.attributes.looks[3].image = kNone;  // nothing needs layers
    expect_same(read_by_peer(write_textured(textured)), textured.soup);
  }
}

TEST(ThreemfPeer, ReadsColoursStrictly) {
  ThreemfSoup textured = random_threemf_soup(3);
  textured.attributes.corners.erase(textured.attributes.corners.begin());
  textured.attributes.materials = {};
  expect_same(read_by_peer(write_textured(textured)), textured.soup);
}

// Of layers this version of lib3mf knows nothing, and passes over them.
TEST(ThreemfPeer, ReadsTrianglesWithLayersOfProperties) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const ThreemfSoup textured = random_threemf_soup(seed);
    expect_same(read_by_peer(write_textured(textured), false), textured.soup);
  }
}

}  // namespace
}  // namespace meshrepair
