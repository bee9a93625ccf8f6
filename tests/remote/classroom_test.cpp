#include "remote/classroom.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "remote/class_news.h"

namespace myotact::remote {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kTeacher = 1, kAnna = 2, kBen = 3;
constexpr std::chrono::steady_clock::time_point kStart{std::chrono::hours(1)};

Classroom class_of_two() {
  Classroom room;
  room.set_members({{kTeacher, net::Role::Instructor, -1, "teacher"},
                    {kAnna, net::Role::Student, 0, "Anna"},
                    {kBen, net::Role::Student, -1, "<b>Ben</b>\n"}},
                   kStart);
  return room;
}

void say(Classroom& room, std::uint32_t client, const Json& wish) {
  room.obey({client, client == kTeacher ? net::Role::Instructor : net::Role::Student, wish.dump()});
}

Json heard(Classroom& room, bool by_instructor) {
  const net::Announcement said = room.announcement();
  return Json::parse(by_instructor ? said.to_instructors : said.to_all).at("class");
}

std::string refusal(Classroom& room, std::uint32_t client, const Json& wish) {
  try {
    say(room, client, wish);
  } catch (const Error& failure) {
    return failure.what();
  }
  return "";
}

TEST(Classroom, StudentsHearWhatIsForAllAndTheInstructorWhoTheyAre) {
  Classroom room = class_of_two();
  room.invite("http://127.0.0.1:7481/#token=00");
  const Json student = heard(room, false), instructor = heard(room, true);
  EXPECT_EQ(student.at("students"), 2);
  EXPECT_FALSE(student.contains("members")) << "names are the instructor's alone";
  EXPECT_FALSE(student.contains("results") || student.contains("join"));
  EXPECT_EQ(instructor.at("join"), "http://127.0.0.1:7481/#token=00");
  ASSERT_EQ(instructor.at("members").size(), 3u);
  EXPECT_EQ(instructor.at("members")[2].at("name"), "<b>Ben</b> ") << "as it was typed, but of one line";
}

TEST(Classroom, AWindowReadsWhatItShowsOutOfWhatAnInstructorHears) {
  Classroom room = class_of_two();
  room.invite("http://127.0.0.1:7481/#token=00");
  say(room, kBen, {{"do", "class_hand_up"}, {"on", true}});
  const net::Announcement said = room.announcement();
  const auto news = class_news(said.to_instructors);
  ASSERT_TRUE(news);
  EXPECT_EQ(news->join_link, "http://127.0.0.1:7481/#token=00");
  EXPECT_EQ(news->students, 2u);
  EXPECT_EQ(news->hands_up, 1u);
  EXPECT_EQ(class_news(said.to_all)->join_link, "") << "a student needs none";
  for (const char* nonsense : {"", "7", "{", R"({"class":7})", R"({"name":"elbow"})"}) {
    EXPECT_FALSE(class_news(nonsense)) << nonsense;
  }
  const auto odd = class_news(R"({"class":{"join":7,"students":-1,"hands_up":{}}})");
  ASSERT_TRUE(odd);
  EXPECT_EQ(odd->join_link + std::to_string(odd->students + odd->hands_up), "0");
}

TEST(Classroom, AnswersAreOfTheQuestionThatIsAsked) {
  Classroom room = class_of_two();
  const Json question = {{"id", "q1"}, {"text", "Which flexes?"}, {"options", {"biceps", "triceps"}}};
  say(room, kTeacher, {{"do", "class_ask"}, {"question", question}});
  EXPECT_EQ(heard(room, false).at("question"), question);
  say(room, kAnna, {{"do", "class_answer"}, {"question", "q1"}, {"answer", "biceps"}});
  EXPECT_EQ(heard(room, true).at("members")[1].at("answer"), "biceps");
  EXPECT_NE(refusal(room, kBen, {{"do", "class_answer"}, {"question", "q0"}, {"answer", "biceps"}}), "");
  EXPECT_NE(refusal(room, kBen, {{"do", "class_answer"}, {"question", "q1"}, {"answer", "ulna"}}), "");
  Json next = question;
  next["id"] = "q2";
  say(room, kTeacher, {{"do", "class_ask"}, {"question", next}});
  EXPECT_TRUE(heard(room, true).at("members")[1].at("answer").is_null()) << "a new question has no answers yet";
}

TEST(Classroom, OnlyAnInstructorLeads) {
  Classroom room = class_of_two();
  for (const Json& wish :
       {Json{{"do", "class_freeze"}, {"on", true}}, Json{{"do", "class_look"}, {"look", {{"camera", 1}}}},
        Json{{"do", "class_lesson"}, {"lesson", "2_pull_a_line"}}, Json{{"do", "class_ask"}, {"question", nullptr}}}) {
    EXPECT_NE(refusal(room, kAnna, wish).find("only an instructor"), std::string::npos) << wish;
    EXPECT_EQ(refusal(room, kTeacher, wish), "") << wish;
  }
  EXPECT_TRUE(room.frozen());
  EXPECT_EQ(heard(room, false).at("look"), Json({{"camera", 1}}));
  EXPECT_EQ(heard(room, false).at("lesson"), "2_pull_a_line");
}

TEST(Classroom, HandsGoDownWithWhoLeavesAndResultsStay) {
  Classroom room = class_of_two();
  say(room, kAnna, {{"do", "class_hand_up"}, {"on", true}});
  say(room, kAnna,
      {{"do", "class_result"}, {"lesson", "l"}, {"step", 2}, {"answer", "ulna"}, {"points", 0.5}, {"of", 1}});
  EXPECT_EQ(heard(room, false).at("hands_up"), Json({kAnna}));
  room.set_members({{kTeacher, net::Role::Instructor, -1, "teacher"}}, kStart);
  EXPECT_EQ(heard(room, false).at("hands_up"), Json::array());
  const Json result = heard(room, true).at("results").at(0);
  EXPECT_EQ(result.at("name"), "Anna");
  EXPECT_EQ(result.at("points"), 0.5);
}

TEST(Classroom, AClassWithoutAnInstructorIsFreeAfterAWhile) {
  using std::chrono::seconds;
  Classroom room = class_of_two();
  say(room, kTeacher, {{"do", "class_freeze"}, {"on", true}});
  say(room, kTeacher, {{"do", "class_look"}, {"look", {{"camera", 1}}}});
  const std::vector<net::ClientFacts> anna = {{kAnna, net::Role::Student, 0, "Anna"}};
  room.set_members(anna, kStart + seconds(9));
  EXPECT_TRUE(room.frozen()) << "the instructor's page is loaded again";
  room.announcement();
  room.set_members(anna, kStart + seconds(11));
  EXPECT_FALSE(room.frozen());
  EXPECT_TRUE(room.has_news());
  EXPECT_TRUE(heard(room, false).at("look").is_null());
}

TEST(Classroom, OneMembersResultsPushNobodyElsesOut) {
  Classroom room = class_of_two();
  const auto result = [](int step, double points) {
    return Json{{"do", "class_result"}, {"lesson", "l"}, {"step", step}, {"answer", ""}, {"points", points}, {"of", 1}};
  };
  say(room, kBen, result(1, 0.5));
  for (int i = 0; i < 200; ++i) say(room, kAnna, result(i, 0));
  say(room, kAnna, result(199, 1));
  const Json results = heard(room, true).at("results");
  EXPECT_EQ(results.front().at("name"), "<b>Ben</b> ");
  EXPECT_EQ(results.size(), 61u);
  EXPECT_EQ(results.back().at("points"), 1) << "in the place of the one before";
}

TEST(Classroom, WhatChangesNothingIsNoNews) {
  Classroom room = class_of_two();
  room.announcement();
  say(room, kAnna, {{"do", "class_hand_up"}, {"on", false}});
  EXPECT_FALSE(room.has_news());
  EXPECT_NE(refusal(room, kTeacher, {{"do", "class_freeze"}, {"on", true}, {"for", 3}}), "");
  EXPECT_FALSE(room.frozen()) << "what is refused is not done";
}

TEST(Classroom, WhatIsWrongIsRefusedAndChangesNothing) {
  Classroom room = class_of_two();
  room.announcement();
  const std::string long_text(1000, 'x');
  for (const Json& wish :
       {Json{{"do", "class_dance"}}, Json{{"do", "class_freeze"}}, Json{{"do", "class_freeze"}, {"on", 1}},
        Json{{"do", "class_freeze"}, {"on", true}, {"for", 3}},
        Json{{"do", "class_look"}, {"look", std::string(5000, 'x')}},
        Json{{"do", "class_ask"}, {"question", {{"id", "q"}, {"text", long_text}, {"options", {"a", "b"}}}}},
        Json{{"do", "class_ask"}, {"question", {{"id", "q"}, {"text", "t"}, {"options", {"a"}}}}},
        Json{{"do", "class_lesson"}, {"lesson", long_text}},
        Json{{"do", "class_result"}, {"lesson", "l"}, {"step", -1}, {"answer", ""}, {"points", 0}, {"of", 1}}}) {
    EXPECT_NE(refusal(room, kTeacher, wish), "") << wish;
  }
  EXPECT_FALSE(room.has_news());
  EXPECT_TRUE(Classroom::is_for_class(R"({"do": "class_dance"})"));
  for (const char* other : {R"({"do": "reset"})", R"({"do": 1})", "[]", "{", ""})
    EXPECT_FALSE(Classroom::is_for_class(other));
}

TEST(Classroom, WhatIsSaidFitsIntoAFrameWhateverMembersWrite) {
  Classroom room;
  std::vector<net::ClientFacts> members = {{kTeacher, net::Role::Instructor, -1, "teacher"}};
  for (std::uint32_t id = 2; id < 66; ++id) members.push_back({id, net::Role::Student, -1, std::string(48, '"')});
  room.set_members(members, kStart);
  for (int i = 0; i < 200; ++i) {
    room.obey({2u + static_cast<std::uint32_t>(i) % 8u, net::Role::Student,
               Json{{"do", "class_result"},
                    {"lesson", std::string(48, '"')},
                    {"step", i},
                    {"answer", std::string(100, '"')},
                    {"points", 1},
                    {"of", 1}}
                   .dump()});
  }
  EXPECT_LE(room.announcement().to_instructors.size(), net::kMostControl);
  const Json results = heard(room, true).at("results");
  EXPECT_EQ(results.back().at("number"), 200) << "the newest are kept";
}

}  // namespace
}  // namespace myotact::remote
