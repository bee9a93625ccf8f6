#include "view/input/key_choice.h"

#include <set>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace myotact::view {
namespace {

constexpr int kAllMods = GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | GLFW_MOD_ALT;

ChosenKeys read(const std::string& text) {
  const nlohmann::json json = parse_json(text, "settings.json");
  return chosen_keys(JsonValue(json, "settings.json", "/keys"));
}

std::string error_of(const std::string& text) {
  try {
    read(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::BadData);
    return error.what();
  }
  return "";
}

const KeyBinding& first_binding(KeyAction action) {
  for (const KeyBinding& binding : key_bindings()) {
    if (binding.action == action) return binding;
  }
  throw std::logic_error("an action without a key");
}

TEST(KeyNames, GoThereAndBackForEveryKeyAndModifier) {
  std::set<std::string> names;
  for (int key = GLFW_KEY_SPACE; key <= GLFW_KEY_LAST; ++key) {
    for (int mods = 0; mods <= kAllMods; ++mods) {
      const std::string name = key_name(key, mods);
      if (name.empty()) continue;
      EXPECT_TRUE(names.insert(name).second) << name << " is two keys";
      EXPECT_EQ(key_from_name(name), (KeyPressed{key, mods})) << name;
    }
  }
  EXPECT_GT(names.size(), 8u * 80u);  // a keyboard has about a hundred
  EXPECT_EQ(key_name(GLFW_KEY_LEFT_SHIFT, 0), "");
  EXPECT_EQ(key_name(GLFW_KEY_UNKNOWN, 0), "");
  for (const char* wrong : {"", "Ctrl+", "ctrl+f", "Shift+Ctrl+F", "f", "F26", "Num", "Ctrl++", "Ctrl+F "}) {
    EXPECT_EQ(key_from_name(wrong), std::nullopt) << wrong;
  }
}

TEST(ChosenKeysOfSettings, TakeThePlaceOfTheFirstOnes) {
  const std::vector<KeyBinding> bindings = bindings_with(read(R"({"search": "F7", "hide": "Ctrl+F"})"));
  EXPECT_EQ(binding_of(bindings, GLFW_KEY_F7, 0)->action, KeyAction::Search);
  EXPECT_EQ(binding_of(bindings, GLFW_KEY_F, GLFW_MOD_CONTROL)->action, KeyAction::Hide);  // free by now
  EXPECT_EQ(binding_of(bindings, GLFW_KEY_H, 0), nullptr);
  EXPECT_EQ(binding_of(bindings, GLFW_KEY_L, 0)->action, KeyAction::Labels);
  const std::vector<KeyBinding> exchanged = bindings_with(read(R"({"undo": "Ctrl+Y", "redo": "Ctrl+Z"})"));
  EXPECT_EQ(binding_of(exchanged, GLFW_KEY_Z, GLFW_MOD_CONTROL)->action, KeyAction::Redo);
}

TEST(ChosenKeysOfSettings, MoveTheClutchWhichStaysOneToBeHeld) {
  const std::vector<KeyBinding> bindings = bindings_with(read(R"({"clutch": "X"})"));
  const KeyBinding* clutch = binding_of(bindings, GLFW_KEY_X, 0);
  ASSERT_NE(clutch, nullptr);
  EXPECT_EQ(clutch->action, KeyAction::Clutch);
  EXPECT_EQ(name_of(*clutch), "X (hold)");
  EXPECT_EQ(binding_of(bindings, GLFW_KEY_C, 0), nullptr);
}

TEST(ChosenKeysOfSettings, ThatCannotBeAreRefusedByName) {
  EXPECT_NE(error_of(R"({"serach": "F7"})").find("\"serach\""), std::string::npos);
  EXPECT_NE(error_of(R"({"search": "Strg+K"})").find("\"Strg+K\" is no key"), std::string::npos);
  EXPECT_NE(error_of(R"({"search": 7})").find("/keys/search"), std::string::npos);
  EXPECT_NE(error_of(R"({"search": "H"})"), "");                 // of "hide"
  EXPECT_NE(error_of(R"({"search": "F7", "hide": "F7"})"), "");  // one key for two
  EXPECT_NE(error_of(R"({"search": "Shift+Esc"})"), "");         // Esc stops the forces with any modifier
  EXPECT_NE(error_of(R"({"stop_forces": "F7"})"), "");           // stays where everyone finds it
  EXPECT_NE(error_of(R"({"grab_line": "Ctrl+K"})"), "");         // is held while Ctrl moves the hand
  EXPECT_NE(error_of(R"({"clutch": "Ctrl+K"})"), "");            // is held, too
  EXPECT_NE(error_of(R"([])"), "");
}

TEST(KeyRefusal, NamesTheActionThatHasTheKey) {
  const std::vector<KeyBinding> bindings = bindings_with({});
  const std::string why = refusal(bindings, KeyAction::Search, {GLFW_KEY_H, 0});
  EXPECT_NE(why.find("hide what is selected"), std::string::npos) << why;
  EXPECT_EQ(refusal(bindings, KeyAction::Hide, {GLFW_KEY_H, 0}), "");
  EXPECT_EQ(refusal(bindings, KeyAction::Search, {GLFW_KEY_F7, 0}), "");
  EXPECT_NE(refusal(bindings, KeyAction::Search, {GLFW_KEY_CAPS_LOCK, 0}), "");
  for (const KeyAction action : {KeyAction::StopForces, KeyAction::EnableForces}) {
    EXPECT_TRUE(is_fixed(action));
    ChosenKeys forced{{action_name(first_binding(action)), "F7"}};
    EXPECT_EQ(binding_of(bindings_with(forced), GLFW_KEY_F7, 0), nullptr);
  }
}

}  // namespace
}  // namespace myotact::view
