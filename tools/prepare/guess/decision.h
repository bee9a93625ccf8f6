#pragma once

#include <string>
#include <vector>

namespace myotact::prepare {

/// Something that the surfaces do not say and a person should look at.
struct Decision {
  std::string about;  // "units", "frame", "parts", "names", "attachments", "joints", "mechanics"
  std::string part;   // key; empty: the whole limb
  std::string text;   // what was taken, and what to do where it is wrong
  std::vector<std::string> suggestions = {};
  std::string pointer = {};  // of the value in the recipe
  bool sure = false;         // rather for the record than for a person
};

}  // namespace myotact::prepare
