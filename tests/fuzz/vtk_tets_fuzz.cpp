#include "fuzz/check.h"
#include "geometry/parse_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  testing::check_reader("f.vtk", [&] {
    const geometry::TetFile file = geometry::parse_vtk(testing::as_text(data, size), "f.vtk");
    testing::check_tets(file);
    testing::check_surface(geometry::boundary_surface(file, "f.vtk"));
  });
  return 0;
}
