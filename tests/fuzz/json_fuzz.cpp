#include <nlohmann/json.hpp>

#include "core/json_reader.h"
#include "fuzz/check.h"

/// Recipes, scenes and tables begin with this reader. What it accepts may be written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  testing::check_reader("f.json", [&] {
    const nlohmann::json json = parse_json(std::string(testing::as_text(data, size)), "f.json");
    testing::require(parse_json(json.dump(), "again.json") == json);
  });
  return 0;
}
