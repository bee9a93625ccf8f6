#include "exchange/opensim.h"
#include "fuzz/check.h"

/// A model that is taken is a specimen without a defect.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  testing::check_reader("f.osim", [&] {
    const auto import = exchange::opensim::parse_model(testing::as_text(data, size), "f.osim");
    testing::require(anatomy::find_defect(import.specimen).empty());
  });
  return 0;
}
