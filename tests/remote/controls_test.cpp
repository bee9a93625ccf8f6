#include "remote/controls.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace myotact::remote {
namespace {

template <typename Order>
Order said(const std::string& control) {
  return std::get<Order>(order_of(control).value());
}

TEST(Controls, SayWhatTheyName) {
  EXPECT_EQ(said<messages::CoContract>(R"({"do": "co_contract", "common": 0.2, "difference": -0.1})").common, 0.2);
  EXPECT_EQ(said<messages::CoContract>(R"({"do": "co_contract", "common": 0.2, "difference": -0.1})").difference, -0.1);
  EXPECT_EQ(said<messages::SetLevels>(R"({"do": "levels", "flexors": 0.3, "extensors": 0.4})").extensors, 0.4);
  EXPECT_TRUE(said<messages::Pause>(R"({"do": "pause", "on": true})").on);
  EXPECT_FALSE(said<messages::HoldPosture>(R"({"do": "hold_posture", "on": false})").on);
  EXPECT_EQ(said<messages::TestShove>(R"({"do": "shove"})").joint, -1);
  EXPECT_EQ(order_of(R"({"do": "stop"})"), std::nullopt);
}

/// What a window asks for comes out at the server as it was meant.
TEST(Controls, GoBothWays) {
  const std::vector<messages::Order> orders = {messages::SetLevels{0.25, 0.5}, messages::CoContract{0.5, -0.25},
                                               messages::FollowScript{},       messages::HoldPosture{false},
                                               messages::SetGravity{true},     messages::Pause{true},
                                               messages::SingleStep{},         messages::Reset{},
                                               messages::TestShove{}};
  for (const messages::Order& order : orders) {
    const std::optional<std::string> control = control_of(order);
    ASSERT_TRUE(control);
    const std::optional<messages::Order> heard = order_of(*control);
    ASSERT_TRUE(heard) << *control;
    EXPECT_EQ(heard->index(), order.index()) << *control;
    EXPECT_EQ(control_of(*heard), control);
  }
  EXPECT_EQ(control_of(messages::EndRecording{}), std::nullopt);  // for the scene's own machine
}

TEST(Controls, BadOnesSayWhere) {
  for (const char* bad :
       {"", "[]", "{}", R"({"do": "fly"})", R"({"do": "co_contract", "common": 2, "difference": 0})",
        R"({"do": "co_contract", "common": 1e999, "difference": 0})", R"({"do": "pause"})", R"({"do": 7})",
        R"({"do": "levels", "flexors": 0.1, "extensors": "all"})", R"({"do": "reset", "file": "/etc/passwd"})"}) {
    EXPECT_THROW(order_of(bad), Error) << bad;
  }
}

}  // namespace
}  // namespace myotact::remote
