// SPDX-License-Identifier: MIT
#include "report/json.h"

#include <limits>

#include <gtest/gtest.h>

#include <base/error.h>

namespace meshrepair {
namespace {

TEST(Json, PairsOfATextAndAValueAreAnObject) {
  EXPECT_EQ(Json({{"a", 1}, {"b", {{"c", nullptr}}}}).dump(), R"({"a":1,"b":{"c":null}})");
  EXPECT_EQ(Json({{"a", 1}, {2, 1}}).dump(), R"([["a",1],[2,1]])");
  EXPECT_EQ(Json({"a", "b"}).dump(), R"(["a","b"])");
}

TEST(Json, KeysKeepTheirOrder) {
  Json json;
  json["z"] = true;
  json["a"] = -2.5;
  json["z"] = 0x1p63;
  json.update({{"m", std::numeric_limits<std::uint64_t>::max()}, {"a", "text"}});
  EXPECT_EQ(json.dump(), R"({"z":9.223372036854776e+18,"a":"text","m":18446744073709551615})");
  json.erase("a");
  EXPECT_FALSE(json.contains("a"));
  EXPECT_EQ(json.size(), 2U);
}

TEST(Json, IsReadAsItWasWritten) {
  const Json json = {{"list", {1, -1, 0.1, "\n\"", true, nullptr}}, {"none", Json::object()}};
  EXPECT_EQ(Json::parse(json.dump(2)).value().dump(), json.dump());
  EXPECT_FALSE(Json::parse("{\"a\": }"));
  EXPECT_FALSE(Json::parse("1 2"));
}

TEST(Json, CountsAreNotNegative) {
  EXPECT_EQ(Json::parse("7").value().as_count(), 7U);
  EXPECT_FALSE(Json::parse("-7").value().as_count());
  EXPECT_FALSE(Json::parse("7.5").value().as_count());
  EXPECT_FALSE(Json("7").as_count());
}

TEST(Json, BytesThatAreNoTextAreReplaced) {
  EXPECT_EQ(Json("\xff").dump(), "\"\xEF\xBF\xBD\"");
  EXPECT_EQ(Json("\xC3\xA4").dump(-1, true), R"("\u00e4")");
}

TEST(Json, ACopyIsAValueOfItsOwn) {
  Json json = {{"a", {1}}};
  const Json copy = json;
  json["a"].push_back(2);
  EXPECT_EQ(copy.dump(), R"({"a":[1]})");
  EXPECT_EQ(json.dump(), R"({"a":[1,2]})");
}

TEST(Json, OnlyArraysAndObjectsHaveMembers) {
  Json text = "text";
  EXPECT_THROW(text.push_back(1), InternalError);
  EXPECT_THROW(text["a"] = 1, InternalError);
  EXPECT_EQ(text.find("a"), nullptr);
  EXPECT_EQ(text.size(), 0U);
}

}  // namespace
}  // namespace meshrepair
