#pragma once

#include <optional>
#include <type_traits>
#include <variant>

#include "messages/control_state.h"
#include "messages/moment.h"

namespace myotact::messages {

// What can be asked of a scene that runs, by its script, a window, a lesson or over the network alike. Levels are
// activations, 0 .. 1. The emergency stop is not one of these: it bypasses every queue, at once.

struct SetLevels {  // of both sides of the co-contraction, which lead from now on
  double flexors = 0.0;
  double extensors = 0.0;
};
struct CoContract {  // the balance leads from now on
  double common = 0.0;
  double difference = 0.0;  // -1 .. 1
};
struct FollowScript {};  // the script leads again
struct Activate {
  int muscle = -1;
  double to = 0.0;
};
struct HoldPosture {
  bool on = true;
};
struct SetGravity {
  bool on = true;
};
struct Shove {  // a constant torque
  int joint = -1;
  double torque_Nm = 0.0;
};
struct TestShove {  // a slow push, then a stroke, with the joint's answer recorded
  int joint = -1;   // -1: the co-contraction's
};
struct Pause {
  bool on = true;
};
struct SingleStep {};
struct Reset {};  // back to the starting posture and the beginning of the script; what a person set stays
struct EndRecording {};
struct ChooseTool {                     // by a hand, as soon as its force has faded out
  int tool = 0;                         // of the scene, 0 or 1
  std::optional<ToolShape> shape = {};  // none: as the scene says
};
struct GoOn {  // from that moment: at rest in its posture, with its activations and with what was in force
  Moment from;
};

using Order = std::variant<SetLevels, CoContract, FollowScript, Activate, HoldPosture, SetGravity, Shove, TestShove,
                           Pause, SingleStep, Reset, EndRecording, ChooseTool, GoOn>;

/// Whether an order is one of these. Who leaves some orders to others names them, so that a new one is not forgotten.
template <class T, class... These>
inline constexpr bool kIsOneOf = (std::is_same_v<T, These> || ...);

/// A slider's jump is spread over this [s], or it would be felt as a blow.
inline constexpr double kGlide_s = 0.1;

/// An order and who gives it. Trivially copyable: crosses threads by a BoundedFifo.
struct Command {
  Order order;
  Commander by = Commander::Window;
  double over_s = kGlide_s;  // in which levels get there, and for which a shove lasts
};
static_assert(std::is_trivially_copyable_v<Command>);

}  // namespace myotact::messages
