#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene_file.h"

// A sweep over any keys of a scene, as `myotact sweep` reads it: docs/sweeps.md documents the file.

namespace myotact::measure {

/// What is varied: a key as --set takes it.
struct SweptKey {
  std::string key;
  std::vector<double> values;    // of a grid
  double low = 0.0, high = 1.0;  // of samples
};

struct SweepPlan {
  std::string file;   // for messages
  std::string scene;  // name, or path
  Overrides set;      // for all points
  std::vector<SweptKey> keys;
  int samples = 0;  // 0: a grid
  std::uint64_t seed = 1;
  double seconds = 0.0;                 // of a run; 0: to the script's end
  std::vector<std::string> quantities;  // dotted places in what measure_point() gives
  std::string hash;                     // of all that decides the results: file, scene, specimen, version

  int points() const;
};

inline constexpr int kMostSweepPoints = 1'000'000;

/// Reads and checks a sweep, and loads its first point's scene to see that it can be. Throws Error: NoInput, or BadData
/// naming file, place, value, allowed range and remedy.
SweepPlan load_sweep(const std::filesystem::path& path, const std::string& version);

/// Values of all keys at a point, 0 .. points() - 1. A grid's last key changes fastest; samples are a Latin hypercube.
std::vector<std::vector<double>> sweep_points(const SweepPlan& plan);

/// The scene of a point. Throws Error.
scene::Scene scene_of_point(const SweepPlan& plan, const std::vector<double>& values);

}  // namespace myotact::measure
