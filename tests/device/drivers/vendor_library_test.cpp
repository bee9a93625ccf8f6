#include "device/drivers/vendor_library.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"

namespace myotact::device {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(VendorLibrary, TheFirstOneThatIsThereIsTaken) {
  const VendorLibrary library("the C library's mathematics", {"libnobody_has_this.so.9", "libm.so.6"});
  EXPECT_EQ(library.path(), "libm.so.6");
  double (*cosine)(double) = nullptr;
  library.bind("cos", cosine);
  EXPECT_EQ(cosine(0.5), std::cos(0.5));
}

TEST(VendorLibrary, WhatIsNotThereNamesAllThatWasTried) {
  try {
    VendorLibrary("libHD of OpenHaptics", {"/nowhere/libHD.so", "libnobody_has_this.so"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::Unavailable);
    EXPECT_THAT(error.what(), AllOf(HasSubstr("libHD of OpenHaptics"), HasSubstr("/nowhere/libHD.so"),
                                    HasSubstr("libnobody_has_this.so")));
  }
}

TEST(VendorLibrary, AMissingSymbolNamesLibraryAndSymbol) {
  const VendorLibrary library("mathematics", {"libm.so.6"});
  double (*function)(double) = nullptr;
  library.bind_if_there("no_such_function", function);
  EXPECT_EQ(function, nullptr);
  try {
    library.bind("no_such_function", function);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("libm.so.6"), HasSubstr("no_such_function")));
  }
}

}  // namespace
}  // namespace myotact::device
