#include "device/ready_finding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"

namespace myotact::device {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const DeviceFinding kNone = {"falcon", "Novint Falcon", false, "no Falcon is plugged in", "plug one in"};
const DeviceFinding kFirst = {"falcon", "Novint Falcon at 1-1", true, "", ""};
const DeviceFinding kLocked = {"falcon:2", "Novint Falcon at 1-2", false, "may not be opened", "copy the rules"};

std::string refusal(const std::vector<DeviceFinding>& findings, const std::string& name) {
  try {
    ready_finding(findings, name);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::Unavailable);
    return error.what();
  }
  return "none";
}

TEST(ReadyFinding, IsTheOneOfTheName) {
  EXPECT_EQ(ready_finding({kFirst, {"falcon:2", "", true, "", ""}}, "falcon:2"), 1U);
}

TEST(ReadyFinding, OneThatCannotBeOpenedIsToldWithItsRemedy) {
  EXPECT_THAT(refusal({kFirst, kLocked}, "falcon:2"),
              AllOf(HasSubstr("may not be opened"), HasSubstr("copy the rules")));
}

TEST(ReadyFinding, OneTooManyIsToldWhichIsTheLast) {
  EXPECT_THAT(refusal({kFirst, kLocked}, "falcon:3"), AllOf(HasSubstr("falcon:3"), HasSubstr("is \"falcon:2\"")));
}

TEST(ReadyFinding, WhereNothingIsPluggedInThatIsTold) {
  EXPECT_EQ(refusal({kNone}, "falcon:2"), "falcon:2: no Falcon is plugged in; plug one in");
}

}  // namespace
}  // namespace myotact::device
