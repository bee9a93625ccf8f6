#include "remote/classroom.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "core/json_reader.h"

namespace myotact::remote {

namespace {

using Json = nlohmann::json;

constexpr const char* kWhere = "class";
constexpr const char* kPrefix = "class_";

// Said again and again, as many of the newest as fit; a page that is there keeps older ones.
constexpr std::size_t kMostResults = 1000;
constexpr std::size_t kMostOwnResults = 60;  // of one member, who cannot push out those of others
constexpr std::size_t kMostLook = 4096;      // bytes, as JSON
constexpr std::size_t kMostQuestion = 400;   // bytes of UTF-8, as all below
constexpr std::size_t kMostOption = 100;
constexpr std::size_t kFewestOptions = 2, kMostOptions = 6;
constexpr std::size_t kMostId = 64;
constexpr double kMostPoints = 1e4;
constexpr int kMostStep = 200;  // of a lesson

bool is_control(unsigned char c) {
  return c < 0x20 || c == 0x7F;
}

std::string text_of(const JsonValue& value, std::size_t most, std::size_t least = 1) {
  std::string text = value.string();
  if (text.size() < least || text.size() > most || std::any_of(text.begin(), text.end(), is_control)) {
    throw value.error(fmt::format("must be a line of {} to {} bytes", least, most));
  }
  return text;
}

/// Control characters take six bytes each in JSON, and say nothing in a name.
std::string plain(std::string name) {
  std::replace_if(name.begin(), name.end(), is_control, ' ');
  return name;
}

Json question_of(const JsonValue& value) {
  if (value.raw().is_null()) return nullptr;
  JsonObject fields(value);
  Json question = {{"id", text_of(fields.at("id"), kMostId)}, {"text", text_of(fields.at("text"), kMostQuestion)}};
  const JsonValue options = fields.at("options");
  for (const JsonValue& option : options.elements()) question["options"].push_back(text_of(option, kMostOption));
  const std::size_t count = options.elements().size();
  if (count < kFewestOptions || count > kMostOptions) {
    throw options.error(fmt::format("must be {} to {} answers to choose from", kFewestOptions, kMostOptions));
  }
  fields.finish();
  return question;
}

Json look_of(const JsonValue& value) {
  if (value.raw().dump().size() > kMostLook) throw value.error(fmt::format("must be at most {} bytes", kMostLook));
  return value.raw();
}

Json lesson_of(const JsonValue& value) {
  if (value.raw().is_null()) return nullptr;
  return text_of(value, kMostId);
}

Json result_of(JsonObject& fields) {
  return {{"lesson", text_of(fields.at("lesson"), kMostId)},
          {"step", fields.at("step").integer_between(0, kMostStep)},
          {"answer", text_of(fields.at("answer"), kMostOption, 0)},
          {"points", fields.at("points").number_between(0.0, kMostPoints)},
          {"of", fields.at("of").number_between(0.0, kMostPoints)}};
}

Json led_of(const std::string& wish, JsonObject& fields) {
  if (wish == "class_freeze") return fields.at("on").boolean();
  if (wish == "class_look") return look_of(fields.at("look"));
  return wish == "class_ask" ? question_of(fields.at("question")) : lesson_of(fields.at("lesson"));
}

/// In their order. `room`: bytes of JSON.
Json newest_that_fit(const std::deque<Json>& results, std::size_t room) {
  auto first = results.end();
  for (std::size_t used = 0; first != results.begin(); --first) {
    used += std::prev(first)->dump().size() + 1;
    if (used > room) break;
  }
  return Json(std::vector<Json>(first, results.end()));
}

}  // namespace

bool Classroom::is_for_class(const std::string& control) {
  try {
    const Json json = parse_json(control, kWhere);
    const auto wish = json.find("do");
    return json.is_object() && wish != json.end() && wish->is_string() && wish->get<std::string>().starts_with(kPrefix);
  } catch (const Error&) {
    return false;
  }
}

void Classroom::obey(const net::ControlRequest& request) {
  const Json json = parse_json(request.text, kWhere);
  JsonObject fields(JsonValue(json, kWhere));
  const std::string wish = fields.at("do").one_of(
      {"class_hand_up", "class_answer", "class_result", "class_freeze", "class_look", "class_ask", "class_lesson"});
  if (wish == "class_hand_up") {
    const bool up = fields.at("on").boolean();
    fields.finish();
    raise_hand(request.client, up);
  } else if (wish == "class_answer") {
    const std::string question = fields.at("question").string(), text = fields.at("answer").string();
    fields.finish();
    answer(request.client, question, text);
  } else if (wish == "class_result") {
    Json result = result_of(fields);
    fields.finish();
    add_result(request.client, std::move(result));
  } else {
    if (request.role != net::Role::Instructor) {
      throw RefusedWish(net::Refusal::NotInstructor, "only an instructor leads the class");
    }
    Json what = led_of(wish, fields);
    fields.finish();
    lead(wish, std::move(what));
  }
}

void Classroom::lead(const std::string& wish, Json what) {
  if (wish == "class_freeze") {
    frozen_ = what.get<bool>();
  } else if (wish == "class_look") {
    look_ = std::move(what);
  } else if (wish == "class_ask") {
    ask(std::move(what));
  } else {
    lesson_ = std::move(what);
  }
  has_news_ = true;
}

void Classroom::raise_hand(std::uint32_t client, bool up) {
  if (std::exchange(said_[client].hand_up, up) != up) has_news_ = true;
}

void Classroom::answer(std::uint32_t client, const std::string& question, const std::string& answer) {
  if (question_.is_null() || question_.at("id") != question) {
    throw RefusedWish(net::Refusal::QuestionClosed, "this question is no longer asked");
  }
  const Json& options = question_.at("options");
  if (std::find(options.begin(), options.end(), answer) == options.end()) {
    throw RefusedWish(net::Refusal::NotUnderstood, "this is none of the answers to choose from");
  }
  if (std::exchange(said_[client].answer, answer) != answer) has_news_ = true;
}

void Classroom::add_result(std::uint32_t client, Json result) {
  const auto member =
      std::find_if(members_.begin(), members_.end(), [&](const auto& facts) { return facts.id == client; });
  result["client"] = client;
  result["name"] = member == members_.end() ? "" : plain(member->name);
  result["number"] = ++result_count_;
  const auto is_same = [&](const Json& other) {
    return other["client"] == client && other["lesson"] == result["lesson"] && other["step"] == result["step"];
  };
  std::erase_if(results_, is_same);
  const auto is_own = [&](const Json& other) { return other["client"] == client; };
  if (static_cast<std::size_t>(std::count_if(results_.begin(), results_.end(), is_own)) >= kMostOwnResults) {
    results_.erase(std::find_if(results_.begin(), results_.end(), is_own));
  }
  results_.push_back(std::move(result));
  if (results_.size() > kMostResults) results_.pop_front();
  has_news_ = true;
}

void Classroom::ask(Json question) {
  question_ = std::move(question);
  for (auto& [client, said] : said_) said.answer.clear();
}

void Classroom::set_members(std::vector<net::ClientFacts> members, std::chrono::steady_clock::time_point now) {
  constexpr std::chrono::seconds kAway(10);
  const bool is_led = std::any_of(members.begin(), members.end(),
                                  [](const auto& facts) { return facts.role == net::Role::Instructor; });
  if (is_led) led_at_ = now;
  if (now - led_at_ > kAway && (frozen_ || !look_.is_null())) {
    frozen_ = false;
    look_ = nullptr;
    has_news_ = true;
  }
  if (members == members_) return;
  members_ = std::move(members);
  std::erase_if(said_, [&](const auto& entry) {
    return std::none_of(members_.begin(), members_.end(), [&](const auto& facts) { return facts.id == entry.first; });
  });
  has_news_ = true;
}

void Classroom::invite(const std::string& link) {
  join_ = link;
  has_news_ = true;
}

Json Classroom::for_all() const {
  Json hands_up = Json::array();
  for (const auto& [client, said] : said_) {
    if (said.hand_up) hands_up.push_back(client);
  }
  const auto students = std::count_if(members_.begin(), members_.end(),
                                      [](const auto& facts) { return facts.role == net::Role::Student; });
  return {{"frozen", frozen_}, {"look", look_},        {"question", question_},
          {"lesson", lesson_}, {"students", students}, {"hands_up", hands_up}};
}

Json Classroom::members_json() const {
  Json members = Json::array();
  for (const net::ClientFacts& facts : members_) {
    const auto said = said_.find(facts.id);
    const std::string answer = said == said_.end() ? "" : said->second.answer;
    members.push_back({{"id", facts.id},
                       {"name", plain(facts.name)},
                       {"role", net::describe(facts.role)},
                       {"hand", facts.hand},
                       {"answer", answer.empty() ? Json() : Json(answer)}});
  }
  return members;
}

net::Announcement Classroom::announcement() {
  has_news_ = false;
  Json body = for_all();
  net::Announcement said;
  said.to_all = Json{{"class", body}}.dump();
  body["members"] = members_json();
  if (!join_.empty()) body["join"] = join_;
  const std::size_t room = net::kMostControl - std::min(net::kMostControl, Json{{"class", body}}.dump().size() + 32);
  body["results"] = newest_that_fit(results_, room);
  said.to_instructors = Json{{"class", body}}.dump();
  return said;
}

}  // namespace myotact::remote
