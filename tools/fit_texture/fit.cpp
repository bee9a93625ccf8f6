#include "fit_texture/fit.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/text.h"
#include "fit_texture/band_limit.h"
#include "fit_texture/burg.h"
#include "haptics/effects/autoregression.h"

namespace myotact::fit_texture {

namespace {

using haptics::kTextureRate_Hz;
using Pieces = std::vector<std::vector<double>>;

constexpr double kAntialias_Hz = 450.0;  // leaves the filter room below half of the rate
constexpr std::size_t kPiece = 100;      // samples: 0.1 s, in which force and speed hardly change
/// Of a node: half a second is 30 samples for each of 16 coefficients.
constexpr std::size_t kFewest = 500;
constexpr double kSilent_N = 1e-6;
constexpr double kMostAboveCap = 0.05;  // as the reader of textures asks

struct Signal {
  std::vector<double> signal_N, normal_force_N, speed_m_s;
};

/// At the texture's rate, slow push taken out; columns beside it stay in step.
Signal prepared(const RecordedSignal& recording, double gain, double cut_Hz) {
  const bool as_it_is = std::abs(recording.rate_Hz / kTextureRate_Hz - 1.0) < 1e-3 && cut_Hz >= kAntialias_Hz;
  const auto at_rate = [&](const std::vector<double>& column) {
    return as_it_is ? column : resampled(column, recording.rate_Hz, kTextureRate_Hz, cut_Hz);
  };
  Signal signal{without_push(at_rate(recording.signal_N), kTextureRate_Hz), at_rate(recording.normal_force_N),
                at_rate(recording.speed_m_s)};
  for (double& x : signal.signal_N) x *= gain;
  return signal;
}

double mean_of(const std::vector<double>& values, std::size_t first, std::size_t count) {
  double sum = 0.0;
  for (std::size_t i = first; i < first + count; ++i) sum += values[i];
  return sum / static_cast<double>(count);
}

/// The node nearest in proportion; nodes are > 0.
std::size_t nearest_node(const std::vector<double>& nodes, double value) {
  std::size_t best = 0;
  const auto far = [&](std::size_t i) { return std::abs(std::log(std::max(value, 1e-9) / nodes[i])); };
  for (std::size_t i = 1; i < nodes.size(); ++i) best = far(i) < far(best) ? i : best;
  return best;
}

/// Pieces of the recording for every node. Neighbours that belong to one node stay one piece.
std::vector<Pieces> sorted_pieces(const Signal& signal, const FitSettings& settings) {
  std::vector<Pieces> nodes(settings.force_N.size() * settings.speed_m_s.size());
  if (nodes.size() == 1) {
    nodes[0].push_back(signal.signal_N);
    return nodes;
  }
  std::size_t last = nodes.size();
  for (std::size_t first = 0; first + kPiece <= signal.signal_N.size(); first += kPiece) {
    const std::size_t node =
        nearest_node(settings.force_N, mean_of(signal.normal_force_N, first, kPiece)) * settings.speed_m_s.size() +
        nearest_node(settings.speed_m_s, mean_of(signal.speed_m_s, first, kPiece));
    if (node != last) nodes[node].emplace_back();
    last = node;
    nodes[node].back().insert(nodes[node].back().end(), signal.signal_N.begin() + static_cast<std::ptrdiff_t>(first),
                              signal.signal_N.begin() + static_cast<std::ptrdiff_t>(first + kPiece));
  }
  return nodes;
}

haptics::VibrationNode fit_node(const Pieces& pieces, int order, const std::string& where) {
  double squares = 0.0;
  std::size_t count = 0;
  for (const std::vector<double>& piece : pieces) {
    for (const double x : piece) squares += x * x;
    count += piece.size();
  }
  if (count < kFewest) {
    throw Error(
        ExitStatus::BadData,
        fmt::format("{}: {} s of vibration; must be at least {} s: record longer, or leave "
                    "the node out",
                    where, to_text(static_cast<double>(count) / kTextureRate_Hz), to_text(kFewest / kTextureRate_Hz)));
  }
  haptics::VibrationNode node;
  node.rms_N = std::sqrt(squares / static_cast<double>(count));
  if (!(node.rms_N > kSilent_N)) {
    throw Error(ExitStatus::BadData, where + ": is silent; check the sensor, --full-scale or --mass");
  }
  if (node.rms_N > haptics::kTextureCap_N) {
    throw Error(
        ExitStatus::BadData,
        fmt::format("{}: {:.3g} N RMS; must be at most {}: give --gain {:.2g}, and say so in "
                    "the note",
                    where, node.rms_N, to_text(haptics::kTextureCap_N), 0.9 * haptics::kTextureCap_N / node.rms_N));
  }
  const std::vector<double> reflection = burg_reflection(pieces, order);
  std::copy(reflection.begin(), reflection.end(), node.reflection.begin());
  return node;
}

haptics::VibrationGrid fit_at(const RecordedSignal& recording, const FitSettings& settings, double cut_Hz,
                              const std::string& name) {
  const Signal signal = prepared(recording, settings.gain, cut_Hz);
  const std::vector<Pieces> pieces = sorted_pieces(signal, settings);
  haptics::VibrationGrid grid;
  grid.order = settings.order;
  grid.force_N = settings.force_N;
  grid.speed_m_s = settings.speed_m_s;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string where = fmt::format("{}: {} N, {} m/s", name, to_text(grid.force_N[i / grid.speed_m_s.size()]),
                                          to_text(grid.speed_m_s[i % grid.speed_m_s.size()]));
    grid.nodes.push_back(fit_node(pieces[i], settings.order, where));
  }
  return grid;
}

bool keeps_to_cap(const haptics::VibrationGrid& grid) {
  return std::all_of(grid.nodes.begin(), grid.nodes.end(), [&](const haptics::VibrationNode& node) {
    const std::span reflection(node.reflection.data(), static_cast<std::size_t>(grid.order));
    return haptics::power_above(reflection, haptics::kTextureCap_Hz, kTextureRate_Hz) <= kMostAboveCap;
  });
}

}  // namespace

haptics::VibrationGrid fit_vibration(const RecordedSignal& recording, const FitSettings& settings,
                                     const std::string& name) {
  if (!(recording.rate_Hz >= 0.999 * kLowestRate_Hz && recording.rate_Hz <= kHighestRate_Hz)) {
    throw bad_data(name, "",
                   fmt::format("a rate of {} Hz; must be between {} and {}: record faster, or resample",
                               to_text(recording.rate_Hz), to_text(kLowestRate_Hz), to_text(kHighestRate_Hz)));
  }
  const bool needs_columns = settings.force_N.size() * settings.speed_m_s.size() > 1;
  if (needs_columns && (recording.normal_force_N.empty() || recording.speed_m_s.empty())) {
    throw Error(ExitStatus::Usage, name +
                                       ": more than one force or speed needs the columns normal_force_N and speed_m_s; "
                                       "without, give one of each");
  }
  // Above the cap nothing may be felt: taken out of the recording where there is too much, narrower until it is gone.
  for (const double cut_Hz : {kAntialias_Hz, haptics::kTextureCap_Hz, 0.8 * haptics::kTextureCap_Hz}) {
    haptics::VibrationGrid grid = fit_at(recording, settings, cut_Hz, name);
    if (keeps_to_cap(grid)) return grid;
  }
  throw bad_data(name, "",
                 fmt::format("more than {} % of the power of a model lie above {} Hz whatever the filter; give a "
                             "higher --order",
                             to_text(100.0 * kMostAboveCap), to_text(haptics::kTextureCap_Hz)));
}

std::string texture_text(const haptics::VibrationGrid& grid, const std::string& tissue, const std::string& note) {
  nlohmann::ordered_json nodes = nlohmann::ordered_json::array();
  for (std::size_t f = 0; f < grid.force_N.size(); ++f) {
    nlohmann::ordered_json row = nlohmann::ordered_json::array();
    for (std::size_t s = 0; s < grid.speed_m_s.size(); ++s) {
      const haptics::VibrationNode& node = grid.node(f, s);
      row.push_back(
          {{"rms_N", node.rms_N},
           {"reflection", std::vector<double>(node.reflection.begin(), node.reflection.begin() + grid.order)}});
    }
    nodes.push_back(row);
  }
  const nlohmann::ordered_json text = {
      {"schema", 1},
      {"tissue", tissue},
      {"note", note},
      {"vibration",
       {{"rate_Hz", kTextureRate_Hz}, {"force_N", grid.force_N}, {"speed_m_s", grid.speed_m_s}, {"nodes", nodes}}}};
  return text.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace myotact::fit_texture
