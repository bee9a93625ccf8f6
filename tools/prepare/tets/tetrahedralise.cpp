#include "prepare/tets/tetrahedralise.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#define TETLIBRARY
#include <tetgen.h>

#include "core/error.h"
#include "prepare/child_process.h"

namespace myotact::prepare {

namespace {

using geometry::TetMesh;
using geometry::TriangleMesh;

/// Surfaces of this project take 3 .. 12 ms; one that is not done by then goes round in circles.
constexpr int kTimeLimit_cpu_s = 60;

/// What the child leaves in the pipe before the nodes (3 doubles each) and tets (4 ints each).
struct ResultHeader {
  std::int32_t nodes = 0;
  std::int32_t tets = 0;
};

/// The surface as TetGen wants it. The arrays belong to `in`, which frees them.
void fill_input(const TriangleMesh& surface, tetgenio& in) {
  in.numberofpoints = static_cast<int>(surface.positions_m.size());
  in.pointlist = new REAL[surface.positions_m.size() * 3];
  for (std::size_t v = 0; v < surface.positions_m.size(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) in.pointlist[3 * v + k] = surface.positions_m[v][static_cast<Eigen::Index>(k)];
  }
  in.numberoffacets = static_cast<int>(surface.triangles.size());
  in.facetlist = new tetgenio::facet[surface.triangles.size()];
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    tetgenio::facet& facet = in.facetlist[t];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::polygon& polygon = facet.polygonlist[0];
    tetgenio::init(&polygon);
    polygon.numberofvertices = 3;
    polygon.vertexlist = new int[3];
    for (std::size_t k = 0; k < 3; ++k) polygon.vertexlist[k] = surface.triangles[t][k];
  }
}

void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

/// What the child does.
std::string run_tetgen(const TriangleMesh& surface) {
  tetgenio in, out;
  fill_input(surface, in);
  char switches[] = "pq1.4/10YQ";
  ::tetrahedralize(switches, &in, &out);
  const ResultHeader header{out.numberofpoints, out.numberoftetrahedra};
  std::string bytes;
  append(bytes, &header, sizeof header);
  append(bytes, out.pointlist, sizeof(REAL) * 3 * static_cast<std::size_t>(header.nodes));
  append(bytes, out.tetrahedronlist, sizeof(int) * 4 * static_cast<std::size_t>(header.tets));
  return bytes;
}

TetMesh parse_result(const std::string& name, const std::string& bytes) {
  ResultHeader header;
  if (bytes.size() >= sizeof header) std::memcpy(&header, bytes.data(), sizeof header);
  const std::size_t nodes = static_cast<std::size_t>(std::max(header.nodes, 0));
  const std::size_t tets = static_cast<std::size_t>(std::max(header.tets, 0));
  const std::size_t node_bytes = nodes * 3 * sizeof(double);
  const std::size_t tet_bytes = tets * 4 * sizeof(int);
  if (tets == 0 || bytes.size() != sizeof header + node_bytes + tet_bytes) {
    throw bad_data(name, "tetrahedra", "none came out; check that the surface is closed and faces outward");
  }
  TetMesh mesh;
  mesh.nodes_m.resize(nodes);
  mesh.corners.resize(tets);
  for (std::size_t n = 0; n < nodes; ++n) {
    std::memcpy(mesh.nodes_m[n].data(), bytes.data() + sizeof header + n * 24, 24);
  }
  std::memcpy(mesh.corners.data(), bytes.data() + sizeof header + node_bytes, tet_bytes);
  for (std::size_t t = 0; t < tets; ++t) {
    if (geometry::corner_volume_m3(mesh, t) < 0.0) std::swap(mesh.corners[t][0], mesh.corners[t][1]);
  }
  return mesh;
}

}  // namespace

TetMesh tetrahedralise(const std::string& name, const TriangleMesh& surface) {
  const ChildResult result = run_in_child([&] { return run_tetgen(surface); }, kTimeLimit_cpu_s);
  switch (result.end) {
    case ChildResult::End::Done:
      return parse_result(name, result.bytes);
    case ChildResult::End::TimedOut:
      throw bad_data(name, "tetrahedra",
                     fmt::format("took more than {} s of processor time; simplify the surface", kTimeLimit_cpu_s));
    case ChildResult::End::Signalled:
      throw bad_data(name, "tetrahedra",
                     fmt::format("TetGen ended with signal {}; most likely triangles of the surface cross each other. "
                                 "Repair the surface and export it again",
                                 result.signal));
    case ChildResult::End::Failed:
      break;
  }
  throw bad_data(name, "tetrahedra",
                 "TetGen refused the surface; most likely triangles cross or overlap. Repair the surface and export it "
                 "again");
}

}  // namespace myotact::prepare
