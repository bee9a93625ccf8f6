#include "core/csv.h"

#include <gtest/gtest.h>

namespace myotact {
namespace {

TEST(CsvField, IsQuotedWhereItHasToBe) {
  EXPECT_EQ(csv_field("Anconeus"), "Anconeus");
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("Triceps brachii, long head"), "\"Triceps brachii, long head\"");
  EXPECT_EQ(csv_field("so \"called\""), "\"so \"\"called\"\"\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
}

TEST(CsvField, IsNoFormula) {
  for (const char* word : {"=1+1", "+1", "-1", "@x"}) EXPECT_EQ(csv_field(word), "'" + std::string(word));
  EXPECT_EQ(csv_field("=a,b"), "\"'=a,b\"");
}

}  // namespace
}  // namespace myotact
