#include "device/own_place.h"

#include <gtest/gtest.h>

namespace myotact::device {
namespace {

TEST(OwnPlace, IsTheSameOneWhileItIsThere) {
  EXPECT_EQ(own_place({"1-1", "1-2"}, "1-2", {"1-1", "1-2"}), 1U);
  EXPECT_EQ(own_place({"1-0", "1-1", "1-2"}, "1-1", {"1-1", "1-2"}), 1U) << "one more came, before it in the list";
}

TEST(OwnPlace, InAnotherSocketItIsTheOneThatWasNotThere) {
  EXPECT_EQ(own_place({"1-2", "1-3"}, "1-1", {"1-1", "1-2"}), 1U);
  EXPECT_EQ(own_place({"3-1"}, "1-1", {"1-1"}), 0U);
}

TEST(OwnPlace, OneThatIsLeftIsNotTakenForTheOther) {
  EXPECT_FALSE(own_place({"1-2"}, "1-1", {"1-1", "1-2"}));
  EXPECT_FALSE(own_place({}, "1-1", {"1-1"}));
}

}  // namespace
}  // namespace myotact::device
