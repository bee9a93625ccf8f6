#pragma once

#include <string>

#include <gtest/gtest.h>

#include "core/error.h"

namespace myotact::testing {

/// The text of the Error that `act` throws; its status must be `status`. No error at all fails the test.
template <class Act>
std::string complaint(ExitStatus status, Act&& act) {
  try {
    act();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), status) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no error was thrown";
  return "";
}

}  // namespace myotact::testing
