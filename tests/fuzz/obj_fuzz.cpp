#include "fuzz/check.h"
#include "geometry/parse_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  testing::check_reader("f.obj",
                        [&] { testing::check_surface(geometry::parse_obj(testing::as_text(data, size), "f.obj")); });
  return 0;
}
