#pragma once

#include <cstdint>

namespace myotact::haptics {

/// What went wrong in a tick, as bits of ToolState::faults. The text tells what was done and what to do.
enum class Fault : std::uint32_t {
  NonFiniteForce = 1u << 0,   // force zero, then back through the ramp. Look at contact stiffness and time step.
  NonFiniteDevice = 1u << 1,  // the device sent no number: force zero while it does. Look at its driver.
  DeviceLost = 1u << 2,       // force zero until the device is back, then armed anew.
  Stopped = 1u << 3,          // force zero until enabled again.
  StaleModel = 1u << 4,       // no new model in time: forces fade. Make the simulation step cheaper.
  BadModel = 1u << 5,         // a model with indices or numbers out of range was ignored: a fault of its writer.
  EnergyInjected = 1u << 6,   // more energy came out than went in: damping was added. Lower the coupling stiffness.
  ProxyRescued = 1u << 7,  // the proxy was found inside and put outside. Lower the tissue's speed or raise the radius.
  ProxyBudget = 1u << 8,   // the proxy stopped short of its goal for this tick. Coarsen the skin.
  MissedDeadline = 1u << 9,  // a tick came late. Free a core, or allow real-time priority.
};

constexpr std::uint32_t bit(Fault fault) {
  return static_cast<std::uint32_t>(fault);
}

}  // namespace myotact::haptics
