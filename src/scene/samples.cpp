#include "scene/samples.h"

#include <array>

#include "core/text.h"

namespace myotact::scene {

namespace {

void append(std::string& csv, double value) {
  csv += ',';
  csv += to_text(value);
}

void append(std::string& csv, const std::array<double, 3>& vector) {
  for (const double component : vector) append(csv, component);
}

}  // namespace

SampleTable::SampleTable(const anatomy::Specimen& specimen, const std::vector<std::string>& hands, int every_nth_tick)
    : muscle_count_(specimen.muscles.size()), every_nth_tick_(every_nth_tick) {
  csv_ = "t_s";
  for (const std::string& hand : hands) {
    const std::string prefix = hands.size() > 1 ? hand + "_" : "";
    for (const char* column : {"tool_x_m", "tool_y_m", "tool_z_m", "proxy_x_m", "proxy_y_m", "proxy_z_m", "force_x_N",
                               "force_y_N", "force_z_N", "line_tension_N", "contact"}) {
      csv_ += ',';
      csv_ += prefix;
      csv_ += column;
    }
  }
  for (std::size_t j = 0; j < specimen.joints.size(); ++j) {
    if (specimen.joints[j].type == anatomy::JointType::Weld) continue;
    moving_joints_.push_back(static_cast<int>(j));
    const std::string& key = specimen.joints[j].key;
    csv_ += "," + key + "_q_rad," + key + "_tau_Nm," + key + "_K_Nm_rad";
  }
  for (const auto& muscle : specimen.muscles) csv_ += ",a_" + muscle.key;
  csv_ += '\n';
}

void SampleTable::add(double time_s, std::span<const ToolSample> tools, const simulation::Simulation& simulation) {
  if (ticks_++ % every_nth_tick_ != 0) return;
  csv_ += to_text(time_s);
  for (const ToolSample& sample : tools) {
    append(csv_, sample.tool.tool_position_world_m);
    append(csv_, sample.tool.proxy_position_world_m);
    append(csv_, sample.tool.force_world_N);
    append(csv_, sample.line_tension_N);
    csv_ += sample.tool.contact.surface >= 0 ? ",1" : ",0";
  }
  for (const int j : moving_joints_) {
    const simulation::JointReadout joint = simulation.joint(j);
    append(csv_, joint.angle_rad);
    append(csv_, joint.net_torque_Nm);
    append(csv_, joint.stiffness_Nm_rad);
  }
  for (std::size_t m = 0; m < muscle_count_; ++m) append(csv_, simulation.activation(static_cast<int>(m)));
  csv_ += '\n';
}

}  // namespace myotact::scene
