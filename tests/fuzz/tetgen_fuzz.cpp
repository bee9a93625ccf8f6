#include "fuzz/check.h"
#include "geometry/parse_mesh.h"

/// The input is a .node file, then "%", then an .ele file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  const std::string_view text = testing::as_text(data, size);
  const std::size_t marker = std::min(text.find('%'), size);
  testing::check_reader("f.", [&] {
    const geometry::TetFile file =
        geometry::parse_tetgen(text.substr(0, marker), text.substr(std::min(marker + 1, size)), "f");
    testing::check_tets(file);
    testing::check_surface(geometry::boundary_surface(file, "f.ele"));
  });
  return 0;
}
