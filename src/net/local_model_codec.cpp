#include "net/local_model_codec.h"

#include <algorithm>
#include <cmath>

#include "net/byte_cursor.h"

namespace myotact::net {

namespace {

using messages::LocalModel;

/// All numbers of a model whose count is fixed, in the order of the wire; `Cursor` reads or writes them.
template <typename Model, typename Visit>
void visit_fixed(Model& model, const Visit& visit) {
  visit(model.sequence);
  visit(model.published_at_ns);
  visit(model.dt_ns);
  visit(model.tool_sequence);
  visit(model.coverage_centre_world_m);
  visit(model.coverage_radius_m);
  auto& contact = model.contact;
  visit(contact.surface);
  visit(contact.force_world_N);
  visit(contact.compliance_m_N);
  auto& line = model.line;
  visit(line.muscle);
  visit(line.fraction);
  visit(line.grab_point_world_m);
  visit(line.proximal_point_world_m);
  visit(line.distal_point_world_m);
  visit(line.tension_N);
  visit(line.length_m);
  visit(line.stiffness_N_m);
  visit(line.damping_Ns_m);
  auto& grip = model.grip;
  visit(grip.body);
  visit(grip.point_rest_m);
  visit(grip.position_world_m);
  visit(grip.velocity_world_m_s);
  visit(grip.acceleration_world_m_s2);
  visit(grip.force_world_N);
  visit(grip.mobility_1_kg);
  visit(grip.stiffness_1_s2);
  visit(grip.damping_1_s);
  auto& joint = model.joint;
  visit(joint.angle_rad);
  visit(joint.velocity_rad_s);
  visit(joint.inertia_kg_m2);
  visit(joint.damping_Nms_rad);
  visit(joint.stiffness_Nm_rad);
  visit(joint.torque_Nm);
  auto& tether = model.tether;
  visit(tether.stiffness_N_m);
  visit(tether.anchor_world_m);
  visit(tether.anchor_velocity_world_m_s);
  auto& reported = model.reported;
  visit(reported.tool_world_m);
  visit(reported.count);
}

template <typename Contact, typename Visit>
void visit_reported(Contact& contact, const Visit& visit) {
  visit(contact.surface);
  visit(contact.point_world_m);
  visit(contact.normal_world);
  visit(contact.penetration_m);
}

void put_triangle(ByteWriter& out, const LocalModel::Triangle& triangle) {
  out.put(triangle.surface);
  out.put(triangle.triangle);
  for (const std::int32_t vertex : triangle.vertices) out.put(static_cast<std::uint8_t>(vertex));
  out.put(static_cast<std::uint8_t>(triangle.tissue.tissue));
  out.put(triangle.tissue.fibre_edges);
}

bool get_triangle(ByteReader& in, int vertex_count, LocalModel::Triangle& triangle) noexcept {
  in.get(triangle.surface);
  in.get(triangle.triangle);
  bool sound = triangle.surface >= 0 && triangle.triangle >= 0;
  for (std::int32_t& vertex : triangle.vertices) {
    std::uint8_t index = 0;
    in.get(index);
    vertex = index;
    sound = sound && vertex < vertex_count;
  }
  std::uint8_t tissue = 0;
  in.get(tissue);
  triangle.tissue.tissue = static_cast<messages::Tissue>(tissue);
  in.get(triangle.tissue.fibre_edges);
  return sound && tissue <= static_cast<std::uint8_t>(messages::Tissue::Skin) &&
         std::isfinite(triangle.tissue.fibre_edges[0]) && std::isfinite(triangle.tissue.fibre_edges[1]);
}

/// Reads a number or some, and remembers whether all were finite.
class SoundReader {
 public:
  explicit SoundReader(ByteReader& in) noexcept : in_(in) {}
  template <typename T>
  void operator()(T& value) const noexcept {
    in_.get(value);
    note(value);
  }
  bool all_finite() const noexcept { return finite_; }

 private:
  void note(std::uint64_t) const noexcept {}
  void note(std::int32_t) const noexcept {}
  void note(double value) const noexcept { finite_ = finite_ && std::isfinite(value); }
  template <std::size_t N>
  void note(const std::array<double, N>& values) const noexcept {
    for (const double value : values) note(value);
  }

  ByteReader& in_;
  mutable bool finite_ = true;
};

}  // namespace

static_assert(messages::kMaxLocalVertices <= 256, "a corner is one byte on the wire");

void encode(const LocalModel& model, Bytes& out) {
  out.clear();
  ByteWriter writer(out);
  visit_fixed(model, [&](const auto& value) { writer.put(value); });
  for (std::int32_t i = 0; i < model.reported.count; ++i) {
    visit_reported(model.reported.contacts[static_cast<std::size_t>(i)], [&](const auto& value) { writer.put(value); });
  }
  writer.put(model.vertex_count);
  writer.put(model.triangle_count);
  for (const auto* positions : {&model.previous_world_m, &model.current_world_m}) {
    for (std::int32_t i = 0; i < model.vertex_count; ++i) writer.put((*positions)[static_cast<std::size_t>(i)]);
  }
  for (std::int32_t i = 0; i < model.triangle_count; ++i) {
    put_triangle(writer, model.triangles[static_cast<std::size_t>(i)]);
  }
}

bool decode(std::span<const std::uint8_t> payload, LocalModel& model) noexcept {
  ByteReader in(payload);
  const SoundReader read(in);
  visit_fixed(model, read);
  messages::ReportedContacts& reported = model.reported;
  if (!in.ok() || reported.count < 0 || reported.count > messages::kMaxReportedContacts) return false;
  for (std::int32_t i = 0; i < reported.count; ++i) {
    visit_reported(reported.contacts[static_cast<std::size_t>(i)], read);
  }
  in.get(model.vertex_count);
  in.get(model.triangle_count);
  const bool counts_fit = model.vertex_count >= 0 && model.vertex_count <= messages::kMaxLocalVertices &&
                          model.triangle_count >= 0 && model.triangle_count <= messages::kMaxLocalTriangles;
  if (!in.ok() || !counts_fit) return false;
  for (auto* positions : {&model.previous_world_m, &model.current_world_m}) {
    for (std::int32_t i = 0; i < model.vertex_count; ++i) read((*positions)[static_cast<std::size_t>(i)]);
  }
  bool sound = true;
  for (std::int32_t i = 0; i < model.triangle_count; ++i) {
    sound = get_triangle(in, model.vertex_count, model.triangles[static_cast<std::size_t>(i)]) && sound;
  }
  return sound && in.done() && read.all_finite();
}

}  // namespace myotact::net
