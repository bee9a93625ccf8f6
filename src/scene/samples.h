#pragma once

#include <span>
#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "messages/tool_state.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// What one tool did in a tick.
struct ToolSample {
  messages::ToolState tool;
  double line_tension_N = 0.0;  // of the line in hand, 0 without one
};

/// samples.csv: one row a tick. Numbers are shortest round-trip text, so equal runs give equal bytes.
class SampleTable {
 public:
  /// `hands`: left or right, of each tool. The columns of several carry it in front.
  SampleTable(const anatomy::Specimen& specimen, const std::vector<std::string>& hands, int every_nth_tick);

  /// `tools`: one a hand.
  void add(double time_s, std::span<const ToolSample> tools, const simulation::Simulation& simulation);

  const std::string& csv() const { return csv_; }

 private:
  std::vector<int> moving_joints_;
  std::size_t muscle_count_;
  int every_nth_tick_;
  int ticks_ = 0;
  std::string csv_;
};

}  // namespace myotact::scene
