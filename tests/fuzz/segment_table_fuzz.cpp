#include "fuzz/check.h"
#include "prepare/volume/segment_table.h"

/// A table that was read comes back the same from its own text.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  testing::check_reader("t.csv", [&] {
    const std::string text(testing::as_text(data, size));
    const prepare::SegmentTable table = prepare::parse_segment_table(text, "t.csv");
    const std::string written = prepare::segment_table_text(table);
    testing::require(prepare::segment_table_text(prepare::parse_segment_table(written, "t.csv")) == written);
  });
  return 0;
}
