// SPDX-License-Identifier: MIT
#include "cells/check_complex.h"

#include <functional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include <base/error.h>

#include "complexes.h"
#include "degenerate_soups.h"

namespace meshrepair {
namespace {

using namespace testing;

struct Damage {
  std::string name;
  std::function<void(CellComplex&)> inflict;
};

void PrintTo(const Damage& d, std::ostream* out) { *out << d.name; }

// A facet with a cell on both sides.
FacetId inner_facet(const CellComplex& complex) {
  FacetId f(0u);
  while (!complex.facets[f].above.valid() || !complex.facets[f].below.valid()) ++f.value;
  return f;
}

EdgeId inner_edge(const CellComplex& complex) {
  return complex.uses[complex.facets[inner_facet(complex)].first_use].edge();
}

std::vector<Damage> damages() {
  return {
      {"UseReversed",
       [](CellComplex& c) { c.uses[c.facets[inner_facet(c)].first_use].directed_edge ^= 1; }},
      {"UseOfAnotherEdge",
       [](CellComplex& c) {
         Use& use = c.uses[c.facets[inner_facet(c)].first_use];
         use.directed_edge = c.uses[use.next].directed_edge;
       }},
      {"UseOfAnotherFacet",
       [](CellComplex& c) { c.uses[c.facets[inner_facet(c)].first_use].facet = FacetId(0u); }},
      {"LoopShortcut",
       [](CellComplex& c) {
         Use& use = c.uses[c.facets[inner_facet(c)].first_use];
         use.next = c.uses[use.next].next;
       }},
      {"LoopShortcutBothWays",
       [](CellComplex& c) {
         const UseId first = c.facets[inner_facet(c)].first_use;
         const UseId after = c.uses[c.uses[first].next].next;
         c.uses[first].next = after;
         c.uses[after].previous = first;
       }},
      {"LoopOfOne",
       [](CellComplex& c) {
         const UseId first = c.facets[inner_facet(c)].first_use;
         c.uses[first].next = c.uses[first].previous = first;
       }},
      {"NextIsInvalid",
       [](CellComplex& c) { c.uses[c.facets[inner_facet(c)].first_use].next = UseId(); }},
      {"EdgeEndMoved",
       [](CellComplex& c) {
         Edge& edge = c.edges[inner_edge(c)];
         VertexId other(0u);
         while (other == edge.ends[0] || other == edge.ends[1]) ++other.value;
         edge.ends[0] = other;
       }},
      {"EdgeEndIsInvalid", [](CellComplex& c) { c.edges[inner_edge(c)].ends[1] = VertexId(); }},
      {"FacetTurnedRound",
       [](CellComplex& c) {
         Facet& f = c.facets[inner_facet(c)];
         std::swap(f.above, f.below);
         std::swap(f.next_above, f.next_below);
       }},
      {"FacetInAnotherCell",
       [](CellComplex& c) {
         Facet& f = c.facets[inner_facet(c)];
         f.above = CellId(c.cells.size() - 1) == f.above || CellId(c.cells.size() - 1) == f.below
                       ? CellId(0u)
                       : CellId(c.cells.size() - 1);
       }},
      {"FacetOnBothSidesTheSame",
       [](CellComplex& c) {
         Facet& f = c.facets[inner_facet(c)];
         f.above = f.below;
       }},
      {"CellOutOfRange",
       [](CellComplex& c) { c.facets[inner_facet(c)].above = CellId(c.cells.size() + 5); }},
      {"InnerFacetOpened",  // taken out of one cell's list and given to the outside
       [](CellComplex& c) {
         const FacetId f = inner_facet(c);
         const CellId cell = c.facets[f].above;
         FacetId* link = &c.cells[cell].first_facet;
         while (*link != f) {
           Facet& at = c.facets[*link];
           link = at.above == cell ? &at.next_above : &at.next_below;
         }
         *link = c.facets[f].next_above;
         c.facets[f].above = CellId();
       }},
      {"FacetListCut",
       [](CellComplex& c) {
         const FacetId first = c.cells[CellId(0u)].first_facet;
         Facet& f = c.facets[first];
         (f.above == CellId(0u) ? f.next_above : f.next_below) = FacetId();
       }},
      {"FacetListGoesRound",
       [](CellComplex& c) {
         const FacetId first = c.cells[CellId(0u)].first_facet;
         Facet& f = c.facets[first];
         (f.above == CellId(0u) ? f.next_above : f.next_below) = first;
       }},
      {"CellWithoutFacets", [](CellComplex& c) { c.cells[CellId(0u)].first_facet = FacetId(); }},
      {"CellThatIsAnother",
       [](CellComplex& c) { c.cells[CellId(0u)].first_facet = c.cells[CellId(1u)].first_facet; }},
      {"RingCut",
       [](CellComplex& c) { c.uses[c.edges[inner_edge(c)].first_use].next_around = UseId(); }},
      {"RingEmpty", [](CellComplex& c) { c.edges[inner_edge(c)].first_use = UseId(); }},
      {"RingGoesRound",
       [](CellComplex& c) {
         const UseId first = c.edges[inner_edge(c)].first_use;
         c.uses[first].next_around = first;
       }},
      {"RingOfAnotherEdge",
       [](CellComplex& c) {
         EdgeId other(0u);
         if (other == inner_edge(c)) ++other.value;
         c.edges[inner_edge(c)].first_use = c.edges[other].first_use;
       }},
      {"UseInNoRing",
       [](CellComplex& c) {
         const Use spare = c.uses[c.facets[inner_facet(c)].first_use];
         c.uses.push_back(spare);
       }},
  };
}

class CheckComplex : public ::testing::TestWithParam<Damage> {};

TEST_P(CheckComplex, FindsDamage) {
  for (const TriangleSoup& soup : {cube(), random_soup(12, 3, 1)}) {
    Cells cells = cells_of(soup);
    ASSERT_NO_THROW(internal::check_complex(cells.complex));
    GetParam().inflict(cells.complex);
    EXPECT_THROW(internal::check_complex(cells.complex), InternalError);
  }
}

INSTANTIATE_TEST_SUITE_P(Damages, CheckComplex, ::testing::ValuesIn(damages()),
                         [](const auto& param_info) { return param_info.param.name; });

TEST(CheckComplex, ASingleBoxIsSound) {
  const CleanSoup soup;
  const CellComplex complex(soup, {{0, 0, 0}, {1, 1, 1}});
  EXPECT_NO_THROW(internal::check_complex(complex));
}

TEST(CheckComplex, SoundComplexesPass) {
  for (const SoupFamily& family : degenerate_families()) {
    SCOPED_TRACE(family.name);
    const Cells cells = cells_of(family.make(2));
    EXPECT_NO_THROW(internal::check_complex(cells.complex));
  }
}

}  // namespace
}  // namespace meshrepair
