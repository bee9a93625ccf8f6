#include "fuzz/check.h"
#include "geometry/parse_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  testing::check_reader("f.ply",
                        [&] { testing::check_surface(geometry::parse_ply(testing::as_text(data, size), "f.ply")); });
  return 0;
}
