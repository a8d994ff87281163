// SPDX-License-Identifier: MIT
// Arrays do not grow beyond what their ids tell.
#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/ids.h>

namespace meshrepair {

// Few enough to be made.
template <>
struct IdKind<struct FewTag> {
  static constexpr std::size_t kMost = 100;
  static constexpr const char* kName = "of a few";
};

namespace {

using FewId = Id<struct FewTag>;
using Few = IdVector<FewId, int>;               // in a TrivialVector
using FewTexts = IdVector<FewId, std::string>;  // in a std::vector

template <class Call>
std::string refusal_of(Call call) {
  try {
    call();
  } catch (const LimitError& error) {
    return error.what();
  }
  return "";
}

template <class Vector>
void fill(Vector& vector) {
  while (vector.size() < FewId::Kind::kMost) vector.push_back({});
}

TEST(IdVector, RefusesTheFirstThatHasNoId) {
  Few few;
  fill(few);
  EXPECT_EQ(refusal_of([&] { few.push_back(1); }), "more than 100 of a few");
  EXPECT_EQ(few.size(), 100u);
  FewTexts texts;
  fill(texts);
  EXPECT_EQ(refusal_of([&] { texts.push_back("one more"); }), "more than 100 of a few");
  EXPECT_EQ(texts.size(), 100u);
}

TEST(IdVector, RefusesItAlsoWhereRoomForMoreWasWanted) {
  Few few;
  few.reserve(1000);
  few.resize(50);
  few.resize(99);
  few.push_back(1);
  EXPECT_EQ(refusal_of([&] { few.push_back(1); }), "more than 100 of a few");
}

TEST(IdVector, RefusesToBeMadeLarger) {
  EXPECT_EQ(refusal_of([] { (void)Few(101); }), "more than 100 of a few");
  Few few(100);
  EXPECT_EQ(refusal_of([&] { few.resize(101); }), "more than 100 of a few");
  EXPECT_EQ(refusal_of([&] { few.assign(101, 1); }), "more than 100 of a few");
}

TEST(IdVector, GrowsByAValueOfItsOwn) {
  Few few;
  few.push_back(7);
  while (few.size() < 100) few.push_back(few[FewId(few.size() - 1)]);
  for (const int value : few) EXPECT_EQ(value, 7);
}

TEST(BeginOfList, RefusesListsBeyond32Bits) {
  const std::size_t most = kNone;
  EXPECT_EQ(begin_of_list(most - 7, 7), kNone - 7);
  EXPECT_EQ(begin_of_list(most, 0), kNone);
  EXPECT_EQ(refusal_of([&] { (void)begin_of_list(most - 7, 8); }),
            "more than 4294967295 elements in lists");
}

}  // namespace
}  // namespace meshrepair
