#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

#include "device/device.h"
#include "haptics/bone_drag.h"
#include "haptics/buzz_detector.h"
#include "haptics/contact_compliance.h"
#include "haptics/contact_settings.h"
#include "haptics/force_gate.h"
#include "haptics/force_methods.h"
#include "haptics/force_parts.h"
#include "haptics/haptic_ports.h"
#include "haptics/line_snap.h"
#include "haptics/moving_surface.h"
#include "haptics/muscle_line_drag.h"
#include "haptics/proxy.h"
#include "haptics/tether.h"
#include "haptics/texture.h"
#include "messages/felt_tool.h"
#include "messages/local_model.h"
#include "messages/tool_state.h"
#include "realtime/bounded_fifo.h"
#include "realtime/latest_value.h"

namespace myotact::haptics {

inline constexpr std::uint64_t kTickPeriod_ns = 1'000'000;

struct HapticSettings {
  /// Penetration and Plane have no friction, damping, texture or compliance. Their k is the contact's stiffness, as far
  /// as the device bears it (stiffness_bound.h), and no more than the force that may be sent over the way out.
  ForceMethod method = ForceMethod::Proxy;
  ContactSettings contact;
  LineDragSettings line;
  LineSnapSettings snap;
  BoneDragSettings bone;  // its force scale is the loop's
  GateSettings gate;
  TextureSettings texture;
  /// Felt over simulated force: muscles pull with 10-1000 N, devices with 3-20 N. The tissue gets the unscaled force.
  double force_scale = 1.0;
  /// A clamp: either button takes the nearest bone, none a muscle line.
  bool takes_bones_only = false;
  /// Stiffnesses stay within what the device bears (stiffness_bound.h) and what the age of the simulation's answer
  /// leaves of it. False: for measurements of where a loop becomes unstable.
  bool limit_stiffness = true;
};

/// What a tick read, decided and wrote, for recorder and tables. tool.force_world_N is what the device was given.
struct HapticTick {
  messages::DeviceState device;
  std::uint64_t model_sequence = 0;  // model in use, 0: none
  messages::ToolState tool;
  double line_tension_N = 0.0;  // of the line in hand, 0: none
  GateState gate = GateState::Off;
};

/// Force of the coupling spring on the hand [N], plus damping while the tool goes into the tissue. The normal part
/// never pulls into the tissue. Zero without contact.
Vec3 coupling_force_N(const Proxy& proxy, const ProxyGoal& device, const ContactSettings& settings) noexcept;

/// One tool, once a millisecond: reads the device and the newest model, computes, gates and writes in the same tick.
///
///   device.read --> [proxy, friction, coupling] + [texture] + [muscle line, bone, tether] --> [ports] --> [force gate]
///        models() newest --^                          device.write, tool_states() newest, ticks() all <--'
///
/// Whoever calls tick() owns the clock: a virtual one in lockstep, HapticThread's when it runs free.
class HapticLoop {
 public:
  /// `device` outlives the loop.
  HapticLoop(device::Device& device, const HapticSettings& settings);

  /// Opens the device, puts the tool where it is and arms the gate. Allocates; throws Error Unavailable. Before the
  /// first tick, by the same clock.
  void prepare(std::uint64_t now_ns);
  /// Never allocates, locks, waits, logs or throws. A clock that stands or runs backwards counts as 1 ms. One thread.
  void tick(std::uint64_t now_ns) noexcept;
  /// Any thread: true: force zero from the next tick on, as the device's stop button does; it stays zero until false:
  /// the gate arms again and ramps up.
  void stop_forces(bool stopped) noexcept { stopped ? gate_.stop() : gate_.enable(); }
  /// Any thread.
  bool is_stopped() const noexcept { return gate_.is_stopped(); }
  /// Haptic thread: tells the next tick that a watchdog took the force away: it comes back through the ramp.
  void note_cut() noexcept { cut_ = true; }
  /// What was changed of the settings because the device does not bear it, one line; or nothing.
  const std::string& notice() const noexcept { return notice_; }
  /// Haptic thread: tells the next tick that deadlines went by.
  void note_missed(std::uint64_t ticks) noexcept { missed_ = missed_ || ticks > 0; }

  realtime::LatestValue<messages::LocalModel>& models() noexcept { return models_; }     // written by the simulation
  realtime::LatestValue<messages::ToolState>& tool_states() noexcept { return tools_; }  // read by the simulation
  realtime::LatestValue<messages::FeltTool>& felt() noexcept { return felt_; }           // read for the drawing
  realtime::BoundedFifo<HapticTick>& ticks() noexcept { return ticks_; }                 // read by the recorder

  // ---- after tick(), in the thread that calls it
  const HapticTick& last_tick() const noexcept { return last_; }
  const messages::ToolState& tool_state() const noexcept { return last_.tool; }
  const messages::FeltTool& felt_tool() const noexcept { return felt_now_; }
  GateState gate_state() const noexcept { return gate_.state(); }
  const HapticPorts& ports() const noexcept { return ports_; }

 private:
  bool take_model(std::uint64_t now_ns) noexcept;
  Vec3 contact_force_N(const ProxyGoal& goal, std::uint64_t now_ns, bool is_new) noexcept;
  Vec3 proxy_force_N(const ProxyGoal& goal, std::uint64_t now_ns) noexcept;
  Vec3 reported_force_N(const Vec3& tool_m, bool is_new) noexcept;
  WayOut reported_way_out(const Vec3& tool_m) const noexcept;
  bool goes_by_reports() const noexcept;
  TetherSpring tether_spring(std::uint64_t now_ns) const noexcept;
  Vec3 bone_force_N(const ProxyGoal& goal, std::uint32_t buttons, bool is_new) noexcept;
  void soften(const Vec3& device_m) noexcept;
  double contact_share() const noexcept;
  PortForces make_passive(const PortForces& felt, const ProxyGoal& goal) noexcept;
  Vec3 texture_force_N(const ProxyGoal& goal, const Vec3& contact_N) noexcept;
  Vec3 gate_and_write(const Vec3& wanted_N, const Vec3& position_m, std::uint32_t buttons,
                      std::uint64_t now_ns) noexcept;
  void tell(const messages::DeviceState& state, const Vec3& sent_N, const Vec3& contact_N) noexcept;
  void tell_felt() noexcept;
  void tell_grabs(messages::ToolState& tool) const noexcept;
  void tell_contact(const Vec3& contact_N, messages::ToolState& tool) const noexcept;
  double reported_stiffness_N_m() const noexcept { return contact_share() * settings_.contact.stiffness_N_m; }
  std::uint32_t proxy_faults() noexcept;
  double model_age_s() const noexcept;

  /// The bone in hand, whichever method holds it.
  struct HeldBone {
    std::int32_t body = -1;
    std::array<double, 3> point_rest_m{};
    double gain = 0.0;
    double stiffness_N_m = 0.0;
    Vec3 target_m = Vec3::Zero();
  };

  device::Device& device_;
  HapticSettings settings_;
  realtime::LatestValue<messages::LocalModel> models_;
  realtime::LatestValue<messages::ToolState> tools_;
  realtime::LatestValue<messages::FeltTool> felt_;
  realtime::BoundedFifo<HapticTick> ticks_;

  MovingSurface surface_;
  Proxy proxy_;
  ContactCompliance compliance_;
  Vec3 tissue_shift_m_ = Vec3::Zero();    // from the played surface to where the touched tissue is
  Vec3 unloaded_moved_m_ = Vec3::Zero();  // in this tick, beyond that surface, of the tissue if nothing touched it
  Texture texture_;
  MuscleLineDrag line_;
  LineSnap snap_;
  BoneDrag bone_;
  PenetrationMethod penetration_;
  PlaneMethod plane_;
  PullingMethod pulling_;
  WayOut way_out_;                        // of the reported contacts; bears: a model is in use
  Vec3 reported_moved_m_ = Vec3::Zero();  // by the report of this tick, as work on the way before it
  HeldBone held_;
  double stiffest_tether_N_m_;  // that the device bears
  TetherSpring tether_;
  HapticPorts ports_;
  BuzzDetector buzz_;
  double age_share_ = 1.0;  // of the contact's stiffness, that the age of the model leaves
  std::string notice_;
  ForceGate gate_;
  TickForces forces_;            // of the last tick
  messages::FeltTool felt_now_;  // and what it told
  HapticTick last_;
  ProxyCounters counted_;
  const messages::LocalModel* model_ = nullptr;  // in use; null: none came yet, or the newest was unsound
  std::uint64_t model_arrived_ns_ = 0;
  std::uint64_t model_interval_ns_ = 0;  // between the last two models; 0: not known
  std::uint64_t last_ns_ = 0;
  std::uint32_t faults_ = 0;
  double dt_s_ = 1e-3;
  bool ticked_ = false;
  bool missed_ = false;
  bool cut_ = false;
};

}  // namespace myotact::haptics
