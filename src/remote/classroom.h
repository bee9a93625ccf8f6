#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "net/server_state.h"

namespace myotact::remote {

/// A wish that is not done, with what to tell who asked.
class RefusedWish : public Error {
 public:
  RefusedWish(net::Refusal kind, const std::string& text) : Error(ExitStatus::Usage, text), kind_(kind) {}
  net::Refusal kind() const { return kind_; }

 private:
  net::Refusal kind_;
};

/// What a class has in common beside the limb: who is in and who raises a hand, where the instructor wants all to look,
/// a question and its answers, a lesson and its results. src/net/README.md lists the messages. One thread.
class Classroom {
 public:
  /// Whether this asks for something of the class, not of the scene.
  static bool is_for_class(const std::string& control);
  /// Does what a member asks for, or nothing of it. Throws RefusedWish, or Error that says what is wrong with it.
  void obey(const net::ControlRequest& request);
  /// Who is in now. What was said by who left, and is no result, goes with them. Without an instructor for ten seconds,
  /// who may only have loaded a page again, the class is no longer frozen nor made to look anywhere.
  void set_members(std::vector<net::ClientFacts> members, std::chrono::steady_clock::time_point now);

  /// The link that an instructor hands to students.
  void invite(const std::string& link);

  /// Whether the hands of all but instructors are to rest.
  bool frozen() const { return frozen_; }
  /// Whether there is news since announcement() was called last.
  bool has_news() const { return has_news_; }
  net::Announcement announcement();

 private:
  /// What one member says besides results.
  struct Said {
    bool hand_up = false;
    std::string answer;  // to the question; empty: none
  };

  void raise_hand(std::uint32_t client, bool up);
  void answer(std::uint32_t client, const std::string& question, const std::string& answer);
  void add_result(std::uint32_t client, nlohmann::json result);
  void ask(nlohmann::json question);
  void lead(const std::string& wish, nlohmann::json what);
  nlohmann::json for_all() const;
  nlohmann::json members_json() const;

  std::vector<net::ClientFacts> members_;
  std::map<std::uint32_t, Said> said_;            // by client
  std::chrono::steady_clock::time_point led_at_;  // an instructor was in
  bool frozen_ = false;
  nlohmann::json look_, question_, lesson_;  // null: none
  std::deque<nlohmann::json> results_;       // the newest of each client, lesson and step
  std::size_t result_count_ = 0;             // so far
  std::string join_;                         // link of students; empty: not known
  bool has_news_ = true;
};

}  // namespace myotact::remote
