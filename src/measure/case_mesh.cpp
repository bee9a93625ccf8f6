#include "measure/case_mesh.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "geometry/box_mesh.h"

namespace myotact::measure {

namespace {

/// A tet's volume over its longest edge cubed must exceed this: coordinates of 16 digits leave 1e-15 of a flat tet, and
/// the thinnest slivers of the canine meshes have 5e-7.
constexpr double kFlattest = 1e-12;

using geometry::TetFile;

TetFile make_box(const JsonValue& value) {
  constexpr double kSmallest_m = 1e-9, kLargest_m = 1e6;
  constexpr int kMostCells = 200'000;  // six tets each: more than 16 GB can factor
  JsonObject box(value);
  const JsonValue size = box.at("size_m");
  const JsonValue count = box.at("cells");
  box.finish();
  Vec3 size_m;
  std::array<int, 3> cells{};
  std::int64_t product = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    size_m[static_cast<Eigen::Index>(axis)] = size.elements(3)[axis].number_between(kSmallest_m, kLargest_m);
    cells[axis] = count.elements(3)[axis].integer_between(1, kMostCells);
    product = std::min<std::int64_t>(product * cells[axis], kMostCells + 1);
  }
  if (product > kMostCells) throw count.error(fmt::format("are more than {} together; use fewer", kMostCells));
  TetFile file;
  file.mesh = geometry::make_box_mesh(size_m, cells);
  return file;
}

double longest_edge_m(const geometry::TetMesh& mesh, std::size_t tet) {
  double longest = 0.0;
  for (const auto& [a, b] : geometry::kTetEdges) {
    const auto node = [&](int k) { return static_cast<std::size_t>(mesh.corners[tet][static_cast<std::size_t>(k)]); };
    longest = std::max(longest, (mesh.nodes_m[node(a)] - mesh.nodes_m[node(b)]).norm());
  }
  return longest;
}

void check_volumes(const CaseMesh& out) {
  for (std::size_t tet = 0; tet < out.mesh.corners.size(); ++tet) {
    const double volume_m3 = geometry::corner_volume_m3(out.mesh, tet);
    const double edge_m = longest_edge_m(out.mesh, tet);
    const double least_m3 = kFlattest * edge_m * edge_m * edge_m;
    if (volume_m3 > least_m3) continue;
    const char* what = volume_m3 < -least_m3 ? "inverted: exchange two of its corners" : "flat: mesh the body again";
    throw bad_data(
        out.file, fmt::format("tet {}", tet),
        fmt::format("has the volume {} m^3; must be > {}; it is {}", to_text(volume_m3), to_text(least_m3), what));
  }
}

/// Drops or adds mid-sides. Added nodes come last and belong to a body when both their corners do.
void fit_to_element(Element element, CaseMesh& out) {
  geometry::TetMesh& mesh = out.mesh;
  if (element != Element::T10) {
    mesh.midsides.clear();
    return;
  }
  if (mesh.quadratic()) return;
  std::vector<std::array<int, 2>> edges;
  mesh = geometry::make_quadratic(mesh, &edges);
  if (out.attachments.empty()) return;
  for (const auto& [a, b] : edges) {
    const int body = out.attachments[static_cast<std::size_t>(a)];
    out.attachments.push_back(body == out.attachments[static_cast<std::size_t>(b)] ? body : -1);
  }
}

/// Nodes of no tet would be unknowns without an equation.
void leave_out_unused(std::size_t nodes_of_file, CaseMesh& out) {
  geometry::TetMesh& mesh = out.mesh;
  std::vector<int> place(mesh.nodes_m.size(), -1);
  const auto mark = [&](int node) { place[static_cast<std::size_t>(node)] = 0; };
  for (const auto& corners : mesh.corners) std::for_each(corners.begin(), corners.end(), mark);
  for (const auto& midsides : mesh.midsides) std::for_each(midsides.begin(), midsides.end(), mark);
  int used = 0;
  for (std::size_t n = 0; n < place.size(); ++n) {
    if (place[n] < 0) continue;
    place[n] = used++;
    mesh.nodes_m[static_cast<std::size_t>(place[n])] = mesh.nodes_m[n];
    if (!out.attachments.empty()) out.attachments[static_cast<std::size_t>(place[n])] = out.attachments[n];
  }
  mesh.nodes_m.resize(static_cast<std::size_t>(used));
  if (!out.attachments.empty()) out.attachments.resize(static_cast<std::size_t>(used));
  const auto renumber = [&](int& node) { node = place[static_cast<std::size_t>(node)]; };
  for (auto& corners : mesh.corners) std::for_each(corners.begin(), corners.end(), renumber);
  for (auto& midsides : mesh.midsides) std::for_each(midsides.begin(), midsides.end(), renumber);
  place.resize(nodes_of_file);
  out.node_of_file = std::move(place);
}

/// The file's fibres, made exactly unit. Zero stands for a tet without any.
void take_fibres(CaseMesh& out) {
  constexpr double kLoosestUnit = 1e-3;  // three digits, as ASCII files may round
  for (std::size_t tet = 0; tet < out.fibres.size(); ++tet) {
    const double length = out.fibres[tet].norm();
    if (length == 0.0) continue;
    if (!(std::abs(length - 1.0) <= kLoosestUnit)) {
      throw bad_data(out.file, fmt::format("tet {}", tet),
                     fmt::format("has a fibre of length {}; must be 1, or 0 for none", to_text(length)));
    }
    out.fibres[tet] /= length;
  }
}

void read_fibre(const JsonValue& value, CaseMesh& out) {
  JsonObject fibre(value);
  const auto field = fibre.find("field");
  const auto direction = fibre.find("direction");
  fibre.finish();
  if (field.has_value() == direction.has_value()) throw value.error("must hold either \"field\" or \"direction\"");
  if (field) {
    field->one_of({"fibre"});
    if (out.fibres.empty()) {
      throw field->error(fmt::format("{} has no cell vectors \"fibre\"; add them, or give a direction", out.file));
    }
    return;
  }
  const Vec3 vector = direction->vec3();
  const double length = vector.stableNorm();
  if (!(length > 0.0 && std::isfinite(length))) throw direction->error("is no direction; must be longer than 0");
  out.fibres.assign(out.mesh.corners.size(), vector / length);
}

}  // namespace

CaseMesh make_case_mesh(TetFile mesh, Element element, const std::string& file) {
  const std::size_t nodes_of_file = mesh.mesh.nodes_m.size();
  CaseMesh out;
  out.file = file;
  out.mesh = std::move(mesh.mesh);
  out.regions = std::move(mesh.regions);
  out.fibres = std::move(mesh.fibres);
  out.attachments = std::move(mesh.attachments);
  out.regions.resize(out.mesh.corners.size(), 0);
  check_volumes(out);
  fit_to_element(element, out);
  leave_out_unused(nodes_of_file, out);
  take_fibres(out);
  return out;
}

CaseMesh read_case_mesh(const MeshKeys& keys) {
  CaseMesh out;
  TetFile file;
  if (keys.mesh.raw().is_object()) {
    JsonObject fields(keys.mesh);
    file = make_box(fields.at("box"));
    fields.finish();
    out.file = keys.mesh.file();
    const std::size_t tets = file.mesh.corners.size();
    if (keys.element == Element::T4F) {
      for (std::size_t tet = 0; tet < tets; ++tet)
        out.patches.push_back(static_cast<int>(tet) / geometry::kTetsOfBoxCell);
    }
  } else {
    const auto path = std::filesystem::path(keys.mesh.file()).parent_path() / keys.mesh.string();
    file = geometry::read_tet_mesh(path);
    out.file = path.string();
  }
  const std::vector<int> patches = std::move(out.patches);
  out = make_case_mesh(std::move(file), keys.element, out.file);
  out.patches = patches;
  if (keys.fibre) read_fibre(*keys.fibre, out);
  return out;
}

}  // namespace myotact::measure
