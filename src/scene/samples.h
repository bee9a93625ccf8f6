#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "messages/tool_state.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// samples.csv (FORMATS: Tables): one row a tick. Numbers are shortest round-trip text, so equal runs give equal bytes.
class SampleTable {
 public:
  SampleTable(const anatomy::Specimen& specimen, int every_nth_tick);

  /// `line_tension_N`: of the line in hand, 0 without one.
  void add(double time_s, const messages::ToolState& tool, double line_tension_N,
           const simulation::Simulation& simulation);

  const std::string& csv() const { return csv_; }

 private:
  std::vector<int> moving_joints_;
  std::size_t muscle_count_;
  int every_nth_tick_;
  int ticks_ = 0;
  std::string csv_;
};

}  // namespace myotact::scene
