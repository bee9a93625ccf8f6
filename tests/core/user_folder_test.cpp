// A person's own files: where the XDG base directory specification puts them.

#include "core/user_folder.h"

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"

namespace myotact {
namespace {

/// Sets a variable of the environment, or removes it, for as long as it lives.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    value == nullptr ? ::unsetenv(name) : ::setenv(name, value, 1);
  }
  ~Variable() { old_ ? ::setenv(name_, old_->c_str(), 1) : ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

TEST(UserFolder, FollowsTheSpecification) {
  const Variable home("HOME", "/home/somebody");
  {
    const Variable data("XDG_DATA_HOME", "/elsewhere");
    const Variable config("XDG_CONFIG_HOME", "/settings");
    EXPECT_EQ(user_data_folder(), "/elsewhere/myotact");
    EXPECT_EQ(user_config_folder(), "/settings/myotact");
  }
  for (const char* ignored : {"relative/path", "", static_cast<const char*>(nullptr)}) {
    const Variable data("XDG_DATA_HOME", ignored);
    const Variable config("XDG_CONFIG_HOME", ignored);
    EXPECT_EQ(user_config_folder(), "/home/somebody/.config/myotact");
    EXPECT_EQ(user_data_folder(), "/home/somebody/.local/share/myotact");
  }
}

TEST(UserFolder, NewPathsAreDatedAndNeverTakeAnOldFile) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "user_folder_test";
  std::filesystem::remove_all(folder);
  const Variable data("XDG_DATA_HOME", folder.c_str());
  for (int i = 0; i < 3; ++i) {
    const std::filesystem::path path = new_user_path("exports", "elbow", ".csv");
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_EQ(path.parent_path(), folder / "myotact" / "exports");
    EXPECT_TRUE(
        std::regex_match(path.filename().string(), std::regex(R"(elbow_\d{4}-\d\d-\d\d_\d\d\.\d\d\.\d\d(_\d)?\.csv)")))
        << path;
    write_file(path, "x");
  }
}

TEST(UserFolder, WithoutAPlaceThereIsASentenceWithARemedy) {
  const Variable data("XDG_DATA_HOME", nullptr);
  const Variable home("HOME", nullptr);
  try {
    new_user_path("exports", "elbow", ".csv");
    FAIL() << "a path without a home";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("XDG_DATA_HOME"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace myotact
