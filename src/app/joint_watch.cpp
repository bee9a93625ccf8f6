#include "app/joint_watch.h"

#include "measure/shove_report.h"
#include "measure/stiffness_band.h"
#include "measure/stiffness_reason.h"

namespace myotact::app {
namespace {

constexpr std::chrono::milliseconds kPeriod(400);  // as fast as words are read; the band takes some ten milliseconds

measure::StiffnessRow row_of(const scene::Scene& scene, const messages::SceneFrame& frame) {
  const auto index = static_cast<std::size_t>(scene.co_contraction->joint);
  const messages::JointFrame& joint = frame.joints[index];
  measure::StiffnessRow row;
  row.joint = scene.specimen.joints[index].key;
  row.q_rad = joint.angle_rad;
  row.K_schur_Nm_rad = joint.stiffness_Nm_rad;
  row.K_passive_Nm_rad = joint.passive_Nm_rad;
  row.K_contact_Nm_rad = joint.contact_Nm_rad;
  row.net_torque_Nm = joint.torque_Nm;
  row.preview = joint.preview;
  row.held = row.converged = true;  // what does not hold is in the session's notice
  for (std::size_t m = 0; m < joint.muscles.size(); ++m) {
    const messages::MuscleJointFrame& part = joint.muscles[m];
    row.K_muscle_Nm_rad += part.line_muscle_Nm_rad;
    row.K_geometry_Nm_rad += part.line_geometry_Nm_rad;
    row.muscles.push_back({scene.specimen.muscles[m].key, frame.activations[m], part.torque_Nm, part.stiffness_Nm_rad,
                           part.line_muscle_Nm_rad, part.line_geometry_Nm_rad});
  }
  return row;
}

}  // namespace

JointWatch::JointWatch(const scene::Scene& scene) : scene_(scene) {
  if (scene.co_contraction) lines_ = measure::line_limb(scene);
}

const view::JointReadings& JointWatch::read(const messages::SceneFrame& frame, scene::FreeSession& session) {
  const auto now = std::chrono::steady_clock::now();
  if (!lines_ || frame.joints.empty() || now < next_) return readings_;
  next_ = now + kPeriod;
  const measure::StiffnessRow row = row_of(scene_, frame);
  std::vector<double> angles_rad;
  for (const messages::JointFrame& joint : frame.joints) angles_rad.push_back(joint.angle_rad);
  const measure::BandPart band =
      measure::whole_band(measure::stiffness_band(*lines_, angles_rad, frame.control.common_now));
  readings_ = {row.K_schur_Nm_rad - band.down_Nm_rad, row.K_schur_Nm_rad + band.up_Nm_rad,
               measure::explain_stiffness(row), ""};
  const scene::ShoveRecord shove = session.fetch_shove();
  if (shove.joint >= 0) readings_.shove = measure::shove_text(measure::report_shove(shove));
  return readings_;
}

}  // namespace myotact::app
