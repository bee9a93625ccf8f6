// The sentences that the simulation builds at run time of faults, stiffness, shoves and its posture are told in the
// languages of the window.

#include "view/ui/retold.h"

#include <cmath>
#include <random>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "core/file.h"
#include "haptics/faults.h"
#include "measure/shove_report.h"
#include "measure/stiffness_reason.h"
#include "support/source_folder.h"
#include "view/ui/text.h"

namespace myotact::view::ui {
namespace {

class Retold : public ::testing::Test {
 protected:
  void SetUp() override { set_language("de"); }
  void TearDown() override { set_language("en"); }

  static void expect_told(const std::string& text) {
    const auto told = retold_whole(text);
    ASSERT_TRUE(told) << "has no German: " << text;
    EXPECT_NE(*told, text);
    for (const char* english : {" the ", " its ", " force ", " joint "}) {
      EXPECT_EQ(told->find(english), std::string::npos) << *told;
    }
  }
};

TEST_F(Retold, EveryFault) {
  int told = 0;
  for (std::uint32_t bit = 1; bit != 0; bit <<= 1) {
    for (const std::string& line : haptics::describe_faults(bit)) {
      expect_told(line);
      ++told;
    }
  }
  EXPECT_GE(told, 17);
}

TEST_F(Retold, WhyAJointIsAsStiffAsItIs) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-3.0, 3.0);
  for (int i = 0; i < 2000; ++i) {
    measure::StiffnessRow row;
    row.K_schur_Nm_rad = i == 0 ? std::nan("") : any(random);
    row.K_muscle_Nm_rad = any(random);
    row.K_geometry_Nm_rad = any(random);
    row.K_contact_Nm_rad = any(random);
    row.K_passive_Nm_rad = any(random);
    row.K_gravity_Nm_rad = i % 3 == 0 ? any(random) : 0.0;
    row.K_low_Nm_rad = any(random);
    row.K_high_Nm_rad = 4.0;
    row.held = i % 5 != 0;
    row.converged = i % 7 != 0;
    if (i % 11 == 0) row.stuck_line = "biceps_brachii";
    if (i % 2 == 0) row.muscles = {{"biceps_brachii", 0.5, 1.0, any(random), any(random), any(random)}};
    expect_told(measure::explain_stiffness(row));
  }
}

TEST_F(Retold, HowAShoveEnds) {
  for (const double stiffness : {-1.0, 2.0}) {
    for (const double damping : {0.1, 0.5, 1.5}) {
      measure::ShoveReport report;
      report.read_stiffness_Nm_rad = stiffness;
      report.mode.damping_ratio = damping;
      report.why = measure::shove_reason(report);
      expect_told(measure::shove_text(report));
    }
  }
}

/// Those that no short run brings about: each piece of their text, as the source has it, is in a text "said.*".
TEST_F(Retold, WhatAScenesNoticesSay) {
  const std::string source = read_file(source_folder() + "/src/scene/conductor.cpp");
  const std::string from = source.substr(source.find("std::string Conductor::weak_tissue"));
  const std::string part = from.substr(0, from.find("double Conductor::script_end_s"));
  const std::string joined = std::regex_replace(part, std::regex(R"("\s*\n\s*")"), "");
  const std::regex literal(R"re("((?:[^"\\]|\\.)*)")re");
  int pieces = 0;
  for (std::sregex_iterator it(joined.begin(), joined.end(), literal), end; it != end; ++it) {
    std::string text = std::regex_replace((*it)[1].str(), std::regex(R"(\\")"), "\"");
    text = std::regex_replace(text, std::regex(R"(\{[^}]*\})"), "{}");
    if (text.size() < 8) continue;
    ++pieces;
    bool known = false;
    for (const auto& [key, english] : english_texts()) {
      known = known || (key.starts_with("said.") && english.find(text) != std::string::npos);
    }
    EXPECT_TRUE(known) << text;
  }
  EXPECT_GE(pieces, 6);
}

/// Each text with values in it, as a sentence, is found again among all of them.
TEST_F(Retold, EachTextIsFoundAmongAll) {
  const Catalogue german = load_catalogue("de");
  const auto with_values = [](std::string text) {
    for (std::size_t at; (at = text.find("{}")) != std::string::npos;) text.replace(at, 2, "7");
    return text;
  };
  for (const auto& [key, english] : english_texts()) {
    if (!key.starts_with("said.")) continue;
    EXPECT_EQ(retold(with_values(english)), with_values(german.at(key))) << key;
  }
}

TEST_F(Retold, WhatIsNotKnownStaysAsItIsAndEnglishIsItself) {
  EXPECT_EQ(retold("disk full: nothing is recorded"), "disk full: nothing is recorded");
  EXPECT_FALSE(retold_whole("disk full: nothing is recorded"));
  EXPECT_EQ(retold(""), "");
  set_language("en");
  const std::string text = haptics::describe_faults(haptics::bit(haptics::Fault::Buzz)).front();
  EXPECT_EQ(retold(text), text);
}

}  // namespace
}  // namespace myotact::view::ui
