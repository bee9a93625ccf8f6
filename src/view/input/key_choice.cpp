#include "view/input/key_choice.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <fmt/format.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "view/ui/text.h"

namespace myotact::view {

std::string action_name(const KeyBinding& binding) {
  constexpr std::string_view kBegin = "keys.";
  return std::string(binding.what).substr(kBegin.size());
}

std::optional<KeyPressed> key_from_name(std::string_view name) {
  constexpr std::array kMods = {std::pair{std::string_view("Ctrl+"), GLFW_MOD_CONTROL},
                                std::pair{std::string_view("Shift+"), GLFW_MOD_SHIFT},
                                std::pair{std::string_view("Alt+"), GLFW_MOD_ALT}};
  KeyPressed pressed;
  std::string_view rest = name;
  for (const auto& [begin, mod] : kMods) {
    if (!rest.starts_with(begin)) continue;
    pressed.mods |= mod;
    rest.remove_prefix(begin.size());
  }
  for (int key = GLFW_KEY_SPACE; key <= GLFW_KEY_LAST; ++key) {
    if (rest.empty() || key_name(key, 0) != rest) continue;
    pressed.key = key;
    return pressed;
  }
  return std::nullopt;
}

bool is_fixed(KeyAction action) {
  return action == KeyAction::StopForces || action == KeyAction::EnableForces;
}

std::vector<KeyBinding> bindings_with(const ChosenKeys& chosen) {
  std::vector<KeyBinding> bindings = key_bindings();
  for (KeyBinding& binding : bindings) {
    const auto found = chosen.find(action_name(binding));
    if (found == chosen.end() || is_fixed(binding.action)) continue;
    const auto pressed = key_from_name(found->second);
    if (!pressed) continue;
    binding.key = pressed->key;
    binding.mods = pressed->mods;
  }
  return bindings;
}

std::string refusal(const std::vector<KeyBinding>& bindings, KeyAction action, const KeyPressed& wanted) {
  const std::string name = shown_key(wanted.key, wanted.mods);
  if (name.empty()) return ui::tr("comfort.key_unknown");
  if (is_fixed(action)) return ui::tr("comfort.key_fixed");
  if (is_held(action) && wanted.mods != 0) return ui::tr("comfort.key_held", name);
  const KeyBinding* owner = binding_of(bindings, wanted.key, wanted.mods);
  if (owner == nullptr || owner->action == action) return "";
  return ui::tr("comfort.key_taken", name, std::string(ui::tr(owner->what)));
}

ChosenKeys chosen_keys(const JsonValue& value) {
  std::vector<std::string> known;
  for (const KeyBinding& binding : key_bindings()) known.push_back(action_name(binding));
  ChosenKeys chosen;
  std::vector<std::pair<std::string, JsonValue>> entries = JsonObject(value).entries();
  for (const auto& [action, key] : entries) {
    if (std::find(known.begin(), known.end(), action) == known.end()) {
      throw key.error(fmt::format("there is no action \"{}\"; the actions are: {}", action, fmt::join(known, ", ")));
    }
    if (!key_from_name(key.string())) {
      throw key.error(fmt::format("\"{}\" is no key; write it as \"F7\", \"Ctrl+K\" or \"Num 7\"", key.string()));
    }
    chosen[action] = key.string();
  }
  const std::vector<KeyBinding> bindings = bindings_with(chosen);
  for (const auto& [action, key] : entries) {
    const auto place = std::find(known.begin(), known.end(), action) - known.begin();
    const std::string why =
        refusal(bindings, key_bindings()[static_cast<std::size_t>(place)].action, *key_from_name(key.string()));
    if (!why.empty()) throw key.error(why);
  }
  // refusal() finds the first owner of a key: of two that share one, the message of the second names the first.
  std::set<std::pair<int, int>> keys;
  for (const KeyBinding& binding : bindings) {
    if (!keys.emplace(binding.key, binding.mods).second) {
      throw value.error(fmt::format("two actions have the key {}", name_of(binding)));
    }
  }
  return chosen;
}

}  // namespace myotact::view
