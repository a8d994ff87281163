// SPDX-License-Identifier: MIT
// lib3mf, the library of those who make 3MF, for tests of what is written.
#pragma once

#include <Model/COM/NMR_DLLInterfaces.h>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/soup.h>

#include "soup_fixtures.h"

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

inline void read_mesh_of_peer(void** mesh, PeerModel& model) {
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

inline PeerModel read_by_peer(std::string bytes, bool strict = true) {
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
    read_mesh_of_peer(mesh.get(), result);
    ++result.objects;
  }
  return result;
}

// The same points in single precision, and the same triangles.
inline void expect_read_by_peer(const std::string& bytes, const TriangleSoup& soup,
                                bool strict = true) {
  const PeerModel peer = read_by_peer(bytes, strict);
  EXPECT_EQ(peer.objects, 1u);
  EXPECT_EQ(peer.triangles, soup.triangles);
  ASSERT_EQ(peer.points.size(), soup.points.size());
  for (std::size_t p = 0; p < soup.points.size(); ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(peer.points[p][i], static_cast<float>(soup.points[p][static_cast<int>(i)]));
    }
  }
}

}  // namespace meshrepair
