#include "haptics/faults.h"

#include <array>

namespace myotact::haptics {

namespace {

constexpr std::array kTexts = {
    FaultText{Fault::Stopped, "stopped", "force zero until forces are enabled again."},
    FaultText{Fault::DeviceLost, "device lost", "force zero until the device is back, then armed anew. Plug it in."},
    FaultText{Fault::NonFiniteDevice, "no number from the device", "force zero while it lasts. Look at its driver."},
    FaultText{Fault::DeviceJumped, "device jumped",
              "force zero, then armed anew: no hand moves that fast. Look at encoders and cable."},
    FaultText{Fault::WatchdogCut, "watchdog",
              "the program hung: force zero, then armed anew. Free a core, or allow real-time priority."},
    FaultText{Fault::NonFiniteForce, "force is not a number",
              "force zero, then back through the ramp. Look at contact stiffness and time step."},
    FaultText{Fault::TooFast, "device too fast", "force zero, then back through the ramp. Move more slowly."},
    FaultText{Fault::StaleModel, "simulation late",
              "forces fade until it catches up. Close other programs, or simulate muscles as lines."},
    FaultText{Fault::BadModel, "unsound model", "it was ignored: indices or numbers are out of range. Report it."},
    FaultText{Fault::ClockBackwards, "clock ran backwards", "counted as one tick. Look at the host's clock."},
    FaultText{Fault::Buzz, "buzz", "the stiffness was halved and recovers slowly. Lower the tool's stiffness."},
    FaultText{Fault::EnergyInjected, "energy injected",
              "more came out than went in: damping was added. Lower the coupling stiffness."},
    FaultText{Fault::StiffnessLowered, "model old",
              "the stiffness was lowered to what its age allows. Close other programs, or simulate muscles as lines."},
    FaultText{Fault::MotorHot, "motors warm", "force lowered towards the continuous rating. Rest for some seconds."},
    FaultText{Fault::ProxyRescued, "proxy rescued",
              "it was found inside and put outside. Lower the tissue's speed or raise the radius."},
    FaultText{Fault::ProxyBudget, "proxy budget", "it stopped short of its goal for this tick. Coarsen the skin."},
    FaultText{Fault::MissedDeadline, "missed deadline", "a tick came late. Free a core, or allow real-time priority."},
};

}  // namespace

std::span<const FaultText> fault_texts() {
  return kTexts;
}

std::vector<std::string> describe_faults(std::uint32_t faults) {
  std::vector<std::string> lines;
  for (const FaultText& text : kTexts) {
    if ((faults & bit(text.fault)) == 0) continue;
    lines.push_back(std::string(text.name) + ": " + std::string(text.remedy));
  }
  return lines;
}

}  // namespace myotact::haptics
