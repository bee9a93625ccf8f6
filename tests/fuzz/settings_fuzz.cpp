#include <set>
#include <utility>

#include "fuzz/check.h"
#include "view/session/settings.h"

/// Settings that are taken keep their limits, give each key to one action, and are the same when they are written and
/// read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  testing::check_reader("f.json", [&] {
    const view::Settings settings = view::parse_settings(std::string(testing::as_text(data, size)), "f.json");
    testing::require(settings.scale >= view::kSmallestScale && settings.scale <= view::kLargestScale);
    std::set<std::pair<int, int>> keys;
    for (const view::KeyBinding& binding : view::bindings_with(settings.keys)) {
      testing::require(keys.emplace(binding.key, binding.mods).second);
      const auto& first = view::key_bindings()[keys.size() - 1];
      testing::require(!view::is_fixed(first.action) || (binding.key == first.key && binding.mods == first.mods));
    }
    testing::require(view::parse_settings(view::settings_text(settings), "f.json") == settings);
  });
  return 0;
}
