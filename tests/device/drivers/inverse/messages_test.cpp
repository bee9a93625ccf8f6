#include "device/drivers/inverse/messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "device/drivers/inverse/states.h"
#include "support/mutator.h"
#include "support/sanitizer.h"

namespace myotact::device::inverse {
namespace {

using ::testing::HasSubstr;

TEST(InverseMessages, AStateIsRead) {
  ServiceMessage message;
  ASSERT_EQ(
      read_message(state_text("049D", {0.01, -0.15, 0.2}, {0.1, 0, -0.3}, R"("a":true,"b":false,"c":true)"), message),
      "");
  ASSERT_EQ(message.devices.size(), 1U);
  const DeviceEntry& device = message.devices[0];
  EXPECT_EQ(device.id, "049D");
  EXPECT_EQ(device.position_service_m[1], -0.15);
  EXPECT_EQ(device.velocity_service_m_s, Vec3(0.1, 0, -0.3));
  ASSERT_EQ(message.grips.size(), 1U);
  EXPECT_EQ(message.grips[0].buttons, 0b101U);
}

TEST(InverseMessages, WhatIsLeftOutIsToldFromZero) {
  ServiceMessage message;
  ASSERT_EQ(read_message(R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{"x":0.1,"z":0}}},
                                         {"device_id":"B"}]})",
                         message),
            "");
  ASSERT_EQ(message.devices.size(), 2U);
  EXPECT_EQ(message.devices[0].position_service_m[0], 0.1);
  EXPECT_FALSE(message.devices[0].position_service_m[1].has_value());
  EXPECT_EQ(message.devices[0].position_service_m[2], 0.0);
  EXPECT_EQ(message.devices[0].velocity_service_m_s, Vec3(0, 0, 0));
  EXPECT_FALSE(message.devices[1].position_service_m[0].has_value());
  EXPECT_TRUE(message.grips.empty());
}

TEST(InverseMessages, BothNamesOfTheButtonsAreTaken) {
  ServiceMessage message;
  ASSERT_EQ(read_message(R"({"verse_grip":[{"device_id":"2","state":{"buttons":{"button_1":true,"button_3":true}}}],
                             "wireless_verse_grip":[{"device_id":"1","state":{"buttons":{"a":true}}}]})",
                         message),
            "");
  ASSERT_EQ(message.grips.size(), 2U);
  EXPECT_EQ(message.grips[0].buttons, 0b0001U) << "wireless grips come first";
  EXPECT_EQ(message.grips[1].buttons, 0b1010U);
  EXPECT_TRUE(message.devices.empty());
}

TEST(InverseMessages, WhatIsBrokenIsNamed) {
  const auto problem = [](const std::string& text) {
    ServiceMessage message;
    return read_message(text, message);
  };
  EXPECT_THAT(problem(""), HasSubstr("no JSON object"));
  EXPECT_THAT(problem("[]"), HasSubstr("no JSON object"));
  EXPECT_THAT(problem(R"({"inverse3":[)"), HasSubstr("no JSON object"));
  EXPECT_THAT(problem(R"({"inverse3":{}})"), HasSubstr("\"inverse3\" is no list"));
  EXPECT_THAT(problem(R"({"inverse3":[3]})"), HasSubstr("no object"));
  EXPECT_THAT(problem(R"({"inverse3":[{}]})"), HasSubstr("device_id"));
  EXPECT_THAT(problem(R"({"inverse3":[{"device_id":5}]})"), HasSubstr("device_id"));
  EXPECT_THAT(problem(R"({"inverse3":[{"device_id":"a\"b"}]})"), HasSubstr("letters"));
  EXPECT_THAT(problem(R"({"inverse3":[{"device_id":""}]})"), HasSubstr("letters"));
  EXPECT_THAT(problem(R"({"inverse3":[{"device_id":"A","state":[]}]})"), HasSubstr("\"state\""));
  EXPECT_THAT(problem(R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{"x":"1"}}}]})"),
              HasSubstr("cursor_position/x"));
  EXPECT_THAT(problem(R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{"y":-2.5}}}]})"),
              HasSubstr("-2 .. 2"));
  EXPECT_THAT(problem(R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{"y":1e999}}}]})"),
              HasSubstr("no JSON object"));
  EXPECT_THAT(problem(R"({"verse_grip":[{"device_id":"A","state":{"buttons":{"a":1}}}]})"), HasSubstr("buttons/a"));
  std::string many = R"({"inverse3":[{"device_id":"0"})";
  for (std::size_t i = 0; i < kMostDevices; ++i) many += R"(,{"device_id":"0"})";
  EXPECT_THAT(problem(many + "]}"), HasSubstr("at most 16"));
  EXPECT_THAT(problem(std::string(kLongestMessage + 1, ' ')), HasSubstr("at most"));
}

TEST(InverseMessages, DeepNestingNeitherCrashesNorCounts) {
  ServiceMessage message;
  const std::size_t depth = 100'000;
  EXPECT_NE(read_message(std::string(depth, '['), message), "");
  EXPECT_EQ(read_message(R"({"other":)" + std::string(depth, '[') + std::string(depth, ']') + "}", message), "");
}

TEST(InverseMessages, BrokenBytesNeverCrash) {
  testing::Mutator mutator;
  const std::string good = state_text("049D", {0.01, -0.15, 0.2}, {0.1, 0, -0.3});
  const int rounds = testing::kSanitizer ? 20'000 : 200'000;
  int refused = 0;
  for (int i = 0; i < rounds; ++i) {
    ServiceMessage message;
    if (!read_message(mutator.broken(good), message).empty()) {
      ++refused;
      continue;
    }
    for (const DeviceEntry& device : message.devices) {
      ASSERT_LE(device.id.size(), kLongestId);
      for (const auto& axis : device.position_service_m) ASSERT_LE(std::abs(axis.value_or(0.0)), 2.0);
    }
  }
  EXPECT_GT(refused, rounds / 2);
}

TEST(InverseMessages, ACommandIsTheOneOfThePages) {
  std::string text;
  write_force_command("049D", {1.5, -0.25, 1e-9}, CommandForm::Values, text);
  const auto values = nlohmann::json::parse(text);
  EXPECT_EQ(values, nlohmann::json::parse(R"({"inverse3":[{"device_id":"049D","commands":{"set_cursor_force":
                                              {"values":{"x":1.5,"y":-0.25,"z":0.0}}}}]})"));
  write_force_command("049D", {1.5, -0.25, 0}, CommandForm::Vector, text);
  EXPECT_EQ(nlohmann::json::parse(text)["inverse3"][0]["commands"]["set_cursor_force"]["vector"]["x"], 1.5);
}

TEST(InverseMessages, TheVersionDecidesTheForm) {
  EXPECT_EQ(form_for(read_version("3.1.1")), CommandForm::Values);
  EXPECT_EQ(form_for(read_version(R"("3.0.2")")), CommandForm::Values);
  EXPECT_EQ(form_for(read_version(R"({"version":"v3.4.0"})")), CommandForm::Values);
  EXPECT_EQ(form_for(read_version("3.5.0")), CommandForm::Vector);
  EXPECT_EQ(form_for(read_version("4.0")), CommandForm::Vector);
  for (const char* other : {"", "<html>1.1</html>", "3", "3.", "v", "-3.1", "{}", R"({"version":3.1})", "null"}) {
    EXPECT_FALSE(read_version(other).has_value()) << other;
    EXPECT_EQ(form_for(read_version(other)), CommandForm::Vector);
  }
}

}  // namespace
}  // namespace myotact::device::inverse
