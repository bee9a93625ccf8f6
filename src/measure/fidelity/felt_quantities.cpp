#include "measure/fidelity/felt_quantities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/dense_matrix.h"
#include "measure/fidelity/felt_masks.h"

namespace myotact::measure {

namespace {

constexpr std::size_t kWindow_ticks = 50;
constexpr std::size_t kFewest_ticks = 20;  // for a slope
constexpr double kSlips_m_s = 5e-3;        // below, sticking to moving tissue and slipping are hard to distinguish
constexpr double kTick_s = 1e-3;

Vec3 place_m(const haptics::HapticTick& tick) {
  return to_vec3(tick.device.stylus_position_world_m);
}
Vec3 normal_of(const haptics::HapticTick& tick) {
  return to_vec3(tick.tool.contact.normal_world);
}

/// Where the touched material point was in the specimen's file: it moves only when the tool slips. Zero for what
/// does not exist.
Vec3 touched_rest_m(const scene::Scene& scene, const messages::ToolContact& contact) {
  const auto muscles = static_cast<int>(scene.specimen.muscles.size());
  const auto surfaces = muscles + static_cast<int>(scene.specimen.bones.size());
  if (contact.surface < 0 || contact.surface >= surfaces) return Vec3::Zero();
  const geometry::TriangleMesh& skin =
      contact.surface < muscles ? scene.specimen.muscles[static_cast<std::size_t>(contact.surface)].skin
                                : scene.specimen.bones[static_cast<std::size_t>(contact.surface - muscles)].surface;
  if (contact.triangle < 0 || contact.triangle >= static_cast<int>(skin.triangles.size())) return Vec3::Zero();
  Vec3 point_m = Vec3::Zero();
  for (std::size_t c = 0; c < 3; ++c)
    point_m +=
        contact.barycentric[c] *
        skin.positions_m[static_cast<std::size_t>(skin.triangles[static_cast<std::size_t>(contact.triangle)][c])];
  return point_m;
}

/// Speed of the tool over the tissue, mean of the window that ends with each tick; 0 unless it touched one surface all
/// the time.
std::vector<double> slip_speeds_m_s(const scene::Scene& scene, const DeviceRun& run) {
  std::vector<double> speeds(run.ticks.size(), 0.0);
  std::vector<double> way_m;  // of the touch up to here
  Vec3 before_m = Vec3::Zero();
  int surface = -1;
  for (std::size_t i = 0; i < run.ticks.size(); ++i) {
    const messages::ToolContact& contact = run.ticks[i].tool.contact;
    if (contact.surface != surface) way_m.clear();
    surface = contact.surface;
    if (surface < 0) continue;
    const Vec3 here_m = touched_rest_m(scene, contact);
    way_m.push_back(way_m.empty() ? 0.0 : way_m.back() + (here_m - before_m).norm());
    before_m = here_m;
    if (way_m.size() <= kWindow_ticks) continue;
    speeds[i] = (way_m.back() - way_m[way_m.size() - 1 - kWindow_ticks]) / (kWindow_ticks * kTick_s);
  }
  return speeds;
}

/// Slope of y over x by least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<double>(x.size());
  double mean_x = 0.0, mean_y = 0.0, product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) mean_x += x[i] / count, mean_y += y[i] / count;
  for (std::size_t i = 0; i < x.size(); ++i) {
    product += (x[i] - mean_x) * (y[i] - mean_y);
    square += (x[i] - mean_x) * (x[i] - mean_x);
  }
  return product / square;
}

/// The first tick from `first` on in which the touch is over, or the hand went along the surface more than into it for
/// the last 50 ms.
std::size_t end_of_loading(const DeviceRun& run, const ForceSeries& series, std::size_t first) {
  const Vec3 normal = normal_of(run.ticks[first]);
  std::size_t end = first;
  for (; end < run.ticks.size() && holds_contact(run.ticks[end]) && series.compared[end]; ++end) {
    if (end < first + kWindow_ticks) continue;
    const Vec3 way_m = series.hand_m[end] - series.hand_m[end - kWindow_ticks];
    const double into_m = -way_m.dot(normal);
    if ((way_m + into_m * normal).norm() > into_m) break;
  }
  return end;
}

/// The loading of the touch [first, end): from where the true normal force passes a fifth of its most to nine tenths.
std::optional<PressStiffness> press_of(const DeviceRun& run, const ForceSeries& series, std::size_t first,
                                       std::size_t end) {
  constexpr double kLeast_N = 0.1, kLeast_m = 3e-4;
  const Vec3 normal = normal_of(run.ticks[first]);
  const auto true_at = [&](std::size_t i) { return series.true_N[i].dot(normal); };
  std::size_t most = first;
  for (std::size_t i = first; i < end; ++i)
    if (true_at(i) > true_at(most)) most = i;
  std::vector<double> depth_m, felt_N, true_N;
  for (std::size_t i = first; i < most; ++i) {
    if (true_at(i) < 0.2 * true_at(most) || true_at(i) > 0.9 * true_at(most)) continue;
    depth_m.push_back(-normal.dot(place_m(run.ticks[i]) - place_m(run.ticks[first])));
    felt_N.push_back(series.commanded_N[i].dot(normal));
    true_N.push_back(true_at(i));
  }
  if (depth_m.size() < kFewest_ticks) return std::nullopt;
  const auto [low, high] = std::minmax_element(depth_m.begin(), depth_m.end());
  if (true_at(most) < kLeast_N || *high - *low < kLeast_m) return std::nullopt;
  return PressStiffness{kTick_s * static_cast<double>(first), *high, slope(depth_m, felt_N), slope(depth_m, true_N)};
}

}  // namespace

std::vector<PressStiffness> press_stiffness(const DeviceRun& run, const ForceSeries& series) {
  std::vector<PressStiffness> presses;
  bool before = false;
  for (std::size_t i = 0; i < run.ticks.size(); ++i) {
    const bool touches = holds_contact(run.ticks[i]) && series.compared[i];
    if (touches && !before) {
      if (const auto press = press_of(run, series, i, end_of_loading(run, series, i))) presses.push_back(*press);
    }
    before = touches;
  }
  return presses;
}

std::optional<SlidingFriction> sliding_friction(const scene::Scene& scene, const DeviceRun& run,
                                                const ForceSeries& series) {
  const scene::ToolSettings& tool = scene.tools.front();
  if (tool.along_over_across != 1.0 || tool.viscous_Ns_m != 0.0) return std::nullopt;
  const std::vector<double> speeds_m_s = slip_speeds_m_s(scene, run);
  SlidingFriction found;
  std::array<double, 2> along_N{}, across_N{};  // felt, true
  for (std::size_t i = 0; i < run.ticks.size(); ++i) {
    if (!series.compared[i] || !holds_contact(run.ticks[i]) || speeds_m_s[i] < kSlips_m_s) continue;
    const Vec3 normal = normal_of(run.ticks[i]);
    const std::array<Vec3, 2> forces_N = {series.commanded_N[i], series.true_N[i]};
    for (std::size_t k = 0; k < 2; ++k) {
      across_N[k] += forces_N[k].dot(normal);
      along_N[k] += (forces_N[k] - forces_N[k].dot(normal) * normal).norm();
    }
    const double share = std::exp(-std::pow(speeds_m_s[i] / tool.stribeck_m_s, 2));
    found.asked += tool.dynamic_friction + share * (tool.static_friction - tool.dynamic_friction);
    ++found.ticks;
  }
  if (found.ticks < kWindow_ticks || !(across_N[0] > 0.0) || !(across_N[1] > 0.0)) return std::nullopt;
  found.felt = along_N[0] / across_N[0];
  found.simulated = along_N[1] / across_N[1];
  found.asked /= static_cast<double>(found.ticks);
  return found;
}

std::optional<JointInHand> joint_in_hand(const scene::Scene& scene, const DeviceRun& run, const ForceSeries& series) {
  if (!scene.co_contraction || run.joints.empty()) return std::nullopt;
  const anatomy::Joint& joint = scene.specimen.joints[static_cast<std::size_t>(scene.co_contraction->joint)];
  const Vec3 axis = joint.axes.front();
  std::vector<std::array<double, 4>> rows;  // angle, speed, 1, torque of the hand
  double read_Nm_rad = 0.0, lowest = 1e300, highest = -1e300, least_rad = 1e300, most_rad = -1e300;
  for (std::size_t i = 0; i + 1 < run.ticks.size(); ++i) {
    const bool ends_step = run.step_of_tick[i + 1] != run.step_of_tick[i];
    if (!ends_step || !series.compared[i] || run.ticks[i].tool.grabbed_body < 0) continue;
    const simulation::JointReadout& now = run.joints[run.step_of_tick[i]];
    const Vec3 torque_Nm = (place_m(run.ticks[i]) - joint.centre_m).cross(-series.commanded_N[i]);
    rows.push_back({now.angle_rad, now.velocity_rad_s, 1.0, axis.dot(torque_Nm) / scene.tools.front().force_scale});
    read_Nm_rad += now.stiffness_Nm_rad;
    lowest = std::min(lowest, now.stiffness_Nm_rad), highest = std::max(highest, now.stiffness_Nm_rad);
    least_rad = std::min(least_rad, now.angle_rad), most_rad = std::max(most_rad, now.angle_rad);
  }
  constexpr double kLeast_rad = 0.5 * std::numbers::pi / 180.0;
  if (rows.size() < kWindow_ticks || most_rad - least_rad < kLeast_rad || highest - lowest > 0.05 * std::abs(highest))
    return std::nullopt;
  Eigen::MatrixXd left(static_cast<Eigen::Index>(rows.size()), 3);
  Eigen::VectorXd right(left.rows());
  for (Eigen::Index r = 0; r < left.rows(); ++r) {
    const std::array<double, 4>& row = rows[static_cast<std::size_t>(r)];
    left.row(r) << row[0], row[1], row[2];
    right[r] = row[3];
  }
  const Eigen::Vector3d fit = least_squares(left, right);
  return JointInHand{fit[0], read_Nm_rad / static_cast<double>(rows.size()), most_rad - least_rad};
}

}  // namespace myotact::measure
