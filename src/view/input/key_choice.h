#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_reader.h"
#include "view/input/key_bindings.h"

namespace myotact::view {

/// Keys that a person chose in place of those of key_bindings(): "search" -> "Ctrl+K", by the names below.
using ChosenKeys = std::map<std::string, std::string>;

/// "search": how settings call what a key does.
std::string action_name(const KeyBinding& binding);

struct KeyPressed {
  int key = 0, mods = 0;  // GLFW_KEY_*, GLFW_MOD_*

  bool operator==(const KeyPressed&) const = default;
};

/// The other way of key_name(); nothing for a text that it never gives.
std::optional<KeyPressed> key_from_name(std::string_view name);

/// The keys of the forces stay where every person and every text looks for them.
bool is_fixed(KeyAction action);

/// key_bindings() with the chosen keys; names that are unknown are passed over.
std::vector<KeyBinding> bindings_with(const ChosenKeys& chosen);

/// Why an action cannot have that key, as a sentence for a person; empty: it can.
std::string refusal(const std::vector<KeyBinding>& bindings, KeyAction action, const KeyPressed& wanted);

/// Chosen keys of a settings file. Throws Error BadData for an action or key that is not known, for a key that the
/// action cannot have, and for one key of two actions.
ChosenKeys chosen_keys(const JsonValue& value);

}  // namespace myotact::view
