#include "remote/controls.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace myotact::remote {
namespace {

TEST(Controls, ChangeWhatTheyName) {
  scene::Requests requests;
  add_control(R"({"do": "co_contract", "common": 0.2, "difference": -0.1})", requests);
  EXPECT_EQ(requests.common, 0.2);
  EXPECT_EQ(requests.difference, -0.1);
  EXPECT_TRUE(requests.balance_asked);
  add_control(R"({"do": "levels", "flexors": 0.3, "extensors": 0.4})", requests);
  EXPECT_TRUE(requests.levels_asked);
  EXPECT_FALSE(requests.balance_asked);
  add_control(R"({"do": "pause", "on": true})", requests);
  EXPECT_TRUE(requests.paused);
  add_control(R"({"do": "shove"})", requests);
  add_control(R"({"do": "shove"})", requests);
  EXPECT_EQ(requests.shoves, 2u);
}

TEST(Controls, BadOnesSayWhereAndChangeNothing) {
  for (const char* bad :
       {"", "[]", "{}", R"({"do": "fly"})", R"({"do": "co_contract", "common": 2, "difference": 0})",
        R"({"do": "co_contract", "common": 1e999, "difference": 0})", R"({"do": "pause"})", R"({"do": 7})",
        R"({"do": "levels", "flexors": 0.1, "extensors": "all"})", R"({"do": "reset", "file": "/etc/passwd"})"}) {
    scene::Requests requests;
    EXPECT_THROW(add_control(bad, requests), Error) << bad;
    EXPECT_EQ(requests.stops, 0u);
  }
}

}  // namespace
}  // namespace myotact::remote
