#include "prepare/tets/tetrahedralise.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#define TETLIBRARY
#include <tetgen.h>

#include "core/error.h"

namespace myotact::prepare {

namespace {

using geometry::TetMesh;
using geometry::TriangleMesh;

/// Surfaces of this project take 3 .. 12 ms; one that is not done by then goes round in circles.
constexpr int kTimeLimit_s = 60;

/// What the child leaves in the pipe before the nodes (3 doubles each) and tets (4 ints each).
struct ResultHeader {
  std::int32_t nodes = 0;
  std::int32_t tets = 0;
};

void write_all(int pipe, const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t done = ::write(pipe, bytes, size);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) ::_exit(3);
    bytes += done;
    size -= static_cast<std::size_t>(done);
  }
}

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

/// The child's whole life. Faults end it by the system's default, whatever handlers the parent had.
[[noreturn]] void run_child(const TriangleMesh& surface, int pipe) {
  for (const int fault : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) ::signal(fault, SIG_DFL);
  const rlimit cpu{kTimeLimit_s, kTimeLimit_s};
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CPU, &cpu);
  ::setrlimit(RLIMIT_CORE, &no_core);
  const int silent = ::open("/dev/null", O_WRONLY);
  if (silent >= 0) {  // TetGen talks on standard output, which carries data
    ::dup2(silent, STDOUT_FILENO);
    ::dup2(silent, STDERR_FILENO);
  }
  try {
    tetgenio in, out;
    fill_input(surface, in);
    char switches[] = "pq1.4/10YQ";
    ::tetrahedralize(switches, &in, &out);
    const ResultHeader header{out.numberofpoints, out.numberoftetrahedra};
    write_all(pipe, &header, sizeof header);
    write_all(pipe, out.pointlist, sizeof(REAL) * 3 * static_cast<std::size_t>(header.nodes));
    write_all(pipe, out.tetrahedronlist, sizeof(int) * 4 * static_cast<std::size_t>(header.tets));
    ::_exit(0);
  } catch (...) {
    ::_exit(2);
  }
}

/// All that the child writes; stops at the time limit with what there is.
std::string read_until_closed(int pipe, bool& timed_out) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(kTimeLimit_s);
  std::string bytes;
  std::vector<char> chunk(1 << 16);
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd wait{pipe, POLLIN, 0};
    const int ready = ::poll(&wait, 1, static_cast<int>(std::max<long long>(left, 0)));
    if (ready < 0 && errno == EINTR) continue;
    timed_out = ready == 0;
    if (ready <= 0) return bytes;
    const ssize_t got = ::read(pipe, chunk.data(), chunk.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return bytes;
    bytes.append(chunk.data(), static_cast<std::size_t>(got));
  }
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
  int ends[2] = {-1, -1};
  if (::pipe(ends) != 0) throw Error(ExitStatus::Internal, name + ": cannot make a pipe: " + std::strerror(errno));
  const pid_t child = ::fork();
  if (child < 0) throw Error(ExitStatus::Internal, name + ": cannot start a process: " + std::strerror(errno));
  if (child == 0) {
    ::close(ends[0]);
    run_child(surface, ends[1]);
  }
  ::close(ends[1]);
  bool timed_out = false;
  const std::string bytes = read_until_closed(ends[0], timed_out);
  ::close(ends[0]);
  if (timed_out) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (timed_out) {
    throw bad_data(name, "tetrahedra", fmt::format("took more than {} s; simplify the surface", kTimeLimit_s));
  }
  if (WIFSIGNALED(status)) {
    throw bad_data(name, "tetrahedra",
                   fmt::format("TetGen ended with signal {}; most likely triangles of the surface cross each other. "
                               "Repair the surface and export it again",
                               WTERMSIG(status)));
  }
  if (WEXITSTATUS(status) != 0) {
    throw bad_data(
        name, "tetrahedra",
        "TetGen refused the surface; most likely triangles cross or overlap. Repair the surface and export it "
        "again");
  }
  return parse_result(name, bytes);
}

}  // namespace myotact::prepare
