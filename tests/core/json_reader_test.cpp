#include "core/json_reader.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/complaint.h"

namespace myotact {
namespace {

using myotact::testing::complaint;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string syntax_error(const std::string& text) {
  return complaint(ExitStatus::BadData, [&] { parse_json(text, "f.json"); });
}

TEST(JsonReader, SyntaxErrorsNameLineAndColumn) {
  EXPECT_THAT(syntax_error("{\n  \"a\": 1,\n  \"b\" 2\n}"), StartsWith("f.json: 3:7: "));
  EXPECT_THAT(syntax_error("x"), StartsWith("f.json: 1:1: "));
  EXPECT_THAT(syntax_error(""), StartsWith("f.json: 1:1: "));
  EXPECT_THAT(syntax_error("[1, 2"), StartsWith("f.json: 1:6: "));
  EXPECT_THAT(syntax_error("[\"\xff\"]"), StartsWith("f.json: 1:3: "));
  EXPECT_THAT(syntax_error("[1,\n 1e999]"), AllOf(StartsWith("f.json: 2:2: "), HasSubstr("smaller")));
}

TEST(JsonReader, WhatIsNoNumberIsNamedAsSuch) {
  for (const char* word : {"NaN", "nan", "-Infinity", "Infinity", "inf", "-inf"}) {
    EXPECT_THAT(syntax_error(std::string("[1,\n ") + word + "]"),
                AllOf(StartsWith("f.json: 2:"), HasSubstr("write a finite one")))
        << word;
  }
  EXPECT_THAT(syntax_error("[nano]"), ::testing::Not(HasSubstr("finite")));
}

TEST(JsonReader, CommentsAreSkipped) {
  EXPECT_EQ(parse_json("// a title\n{\"a\": 1} // end", "f")["a"].get<int>(), 1);
}

TEST(JsonReader, DeepNestingIsRefused) {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  syntax_error(std::string(200'000, '['));
  for (const std::size_t depth : {100u, 200'000u}) {
    EXPECT_THAT(complaint(ExitStatus::BadData, [&] { parse_json(nested(depth), "f"); }), HasSubstr("deeper than 64"));
  }
  EXPECT_EQ(parse_json(nested(60), "f").dump(), nested(60));
}

using Ask = std::function<void(const JsonValue&)>;

struct Wrong {
  const char* json;
  Ask ask;
  const char* told;  // part of the message
};

TEST(JsonReader, WrongValuesNamePointerValueAndRange) {
  const Wrong wrongs[] = {
      {"\"1\"", [](const JsonValue& v) { v.number(); }, "\"1\"; must be a number"},
      {"null", [](const JsonValue& v) { v.number(); }, "null; must be a number"},
      {"{}", [](const JsonValue& v) { v.number(); }, "an object; must be a number"},
      {"3", [](const JsonValue& v) { v.number_between(0.0, 2.5); }, "is 3; must be between 0 and 2.5"},
      {"1.5", [](const JsonValue& v) { v.integer_between(0, 9); }, "is 1.5; must be a whole number"},
      {"1e300", [](const JsonValue& v) { v.integer_between(0, 9); }, "between 0 and 9"},
      {"0", [](const JsonValue& v) { v.boolean(); }, "0; must be true or false"},
      {"7", [](const JsonValue& v) { v.string(); }, "7; must be a text"},
      {"\"hing\"",
       [](const JsonValue& v) {
         v.one_of({"hinge", "ball"});
       },
       "nearest: \"hinge\""},
      {"[1, 2]", [](const JsonValue& v) { v.vec3(); }, "has 2 elements; must have 3"},
      {"5", [](const JsonValue& v) { v.elements(); }, "5; must be a list"},
      {"5", [](const JsonValue& v) { v.elements(3); }, "5; must be a list of 3"},
      {"[]", [](const JsonValue& v) { JsonObject object(v); }, "a list; must be an object"},
  };
  for (const Wrong& wrong : wrongs) {
    const auto json = parse_json(wrong.json, "f");
    const std::string text = complaint(ExitStatus::BadData, [&] { wrong.ask(JsonValue(json, "f", "/a/0")); });
    EXPECT_THAT(text, AllOf(StartsWith("f: /a/0"), HasSubstr(wrong.told))) << wrong.json;
  }
}

TEST(JsonReader, AnElementIsNamedByItsIndex) {
  const auto json = parse_json("[1, 2, \"x\"]", "f");
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { JsonValue(json, "f", "/p").vec3(); }), StartsWith("f: /p/2: "));
}

TEST(JsonReader, LongValuesAreShortened) {
  const auto json = parse_json("\"" + std::string(1'000'000, 'x') + "\"", "f");
  EXPECT_LT(complaint(ExitStatus::BadData, [&] { JsonValue(json, "f").number(); }).size(), 200u);
}

TEST(JsonObject, UnknownKeysNameTheNearestKnownOne) {
  const auto json = parse_json(R"({"name": "a", "peak_forc_N": 1, "x/y~z": 0})", "f");
  JsonObject object(JsonValue(json, "f", "/m"));
  object.string_or("name", "");
  object.number_or("peak_force_N", 0.0);
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { object.finish(); }),
              AllOf(StartsWith("f: /m/peak_forc_N: "), HasSubstr("\"peak_force_N\"")));
  object.find("peak_forc_N");
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { object.finish(); }), StartsWith("f: /m/x~1y~0z: "));  // RFC 6901
}

TEST(JsonObject, MissingKeysAreNamed) {
  const auto json = parse_json("{}", "f");
  JsonObject object(JsonValue(json, "f"));
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { object.at("schema"); }), HasSubstr("\"schema\" is missing"));
  EXPECT_EQ(object.number_or("q", 2.0), 2.0);
  EXPECT_EQ(object.string_or("s", "d"), "d");
  EXPECT_TRUE(object.boolean_or("b", true));
  object.finish();
}

}  // namespace
}  // namespace myotact
