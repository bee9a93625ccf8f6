#include "exchange/febio_read.h"
#include "fuzz/check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  testing::check_reader("f.feb", [&] {
    const measure::SolveCase read =
        exchange::parse_febio(std::string(testing::as_text(data, size)), "f.feb").solve_case;
    const geometry::TetMesh& mesh = read.mesh.mesh;
    testing::require(!mesh.corners.empty() && read.material_of_tet.size() == mesh.corners.size());
    testing::check_positions(mesh.nodes_m);
    testing::check_indices(mesh.corners, mesh.nodes_m.size());
    testing::check_indices(mesh.midsides, mesh.nodes_m.size());
    for (const auto& held : read.loads.held) {
      testing::require(held.node >= 0 && static_cast<std::size_t>(held.node) < mesh.nodes_m.size());
    }
  });
  return 0;
}
