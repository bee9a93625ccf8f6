// The program myotact-fit-texture: a recording of a tool on tissue in, a texture file out.

#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

#include "core/error.h"
#include "core/file.h"
#include "core/log.h"
#include "core/number_list.h"
#include "core/text.h"
#include "fit_texture/fit.h"

namespace {

using myotact::Error;
using myotact::ExitStatus;
namespace fit_texture = myotact::fit_texture;

struct Options {
  std::filesystem::path recording, output;
  std::string force_N = "1", speed_m_s = "0.1", tissue = "muscle", note;
  double full_scale_N = 0.0, mass_kg = 0.0;
  fit_texture::FitSettings fit;
};

void declare(CLI::App& program, Options& options) {
  program
      .add_option("recording", options.recording, "a .wav, or a .csv with columns t_s, force_N or acceleration_m_s2")
      ->required();
  program.add_option("-o,--output", options.output, "texture file to write")->required();
  program.add_option("--force", options.force_N, "normal force of the slide [N], or nodes: 0.5,1,2")
      ->capture_default_str();
  program.add_option("--speed", options.speed_m_s, "speed of the slide [m/s], or nodes")->capture_default_str();
  program.add_option("--full-scale", options.full_scale_N, "of a .wav: the force that its full scale stands for [N]");
  program.add_option("--mass", options.mass_kg, "of what vibrates [kg], for accelerations");
  program.add_option("--gain", options.fit.gain, "on the force")->check(CLI::Range(1e-6, 1e6))->capture_default_str();
  program.add_option("--order", options.fit.order, "coefficients of a model")
      ->check(CLI::Range(1, 30))
      ->capture_default_str();
  program.add_option("--tissue", options.tissue, "of which it is")
      ->check(CLI::IsMember({"muscle", "tendon", "fascia", "bone", "fat", "skin"}))
      ->capture_default_str();
  program.add_option("--note", options.note, "where the recording is from, for the file");
}

std::vector<double> nodes_of(const std::string& option, const std::string& text) {
  const std::vector<double> nodes = myotact::parse_number_list(option, text);
  double last = 0.0;
  for (const double node : nodes) {
    if (!(node > last)) {
      throw Error(ExitStatus::Usage, option + ": " + myotact::to_text(node) + "; nodes must be above 0 and rise");
    }
    last = node;
  }
  return nodes;
}

fit_texture::RecordedSignal read_recording(const Options& options) {
  const std::string kind = myotact::lower(options.recording.extension().string());
  if (kind == ".csv") return fit_texture::read_csv(options.recording, options.mass_kg);
  if (kind != ".wav") throw Error(ExitStatus::Usage, options.recording.string() + ": must be a .wav or a .csv");
  if (!(options.full_scale_N > 0.0)) {
    throw Error(ExitStatus::Usage,
                "--full-scale: must be given for a .wav: the force that its full scale stands for, in N");
  }
  return fit_texture::read_wav(options.recording, options.full_scale_N);
}

int run(Options& options) {
  options.fit.force_N = nodes_of("--force", options.force_N);
  options.fit.speed_m_s = nodes_of("--speed", options.speed_m_s);
  myotact::require_writable(options.output);
  const auto grid = fit_texture::fit_vibration(read_recording(options), options.fit, options.recording.string());
  const std::string note =
      options.note.empty() ? "Fitted to " + options.recording.filename().string() + "." : options.note;
  myotact::write_file(options.output, fit_texture::texture_text(grid, options.tissue, note));
  for (const auto& node : grid.nodes) spdlog::info("{} coefficients, {:.3g} N RMS", grid.order, node.rms_N);
  return 0;
}

int fail(ExitStatus status, const std::string& text) {
  spdlog::error("{}", text);
  return static_cast<int>(status);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Fits the vibration of a texture to a recording of a slide.", "fit-texture");
  Options options;
  declare(program, options);
  try {
    program.parse(argc, argv);
    myotact::start_log("info");
    return run(options);
  } catch (const CLI::ParseError& failure) {
    return program.exit(failure) == 0 ? 0 : static_cast<int>(ExitStatus::Usage);
  } catch (const Error& failure) {
    return fail(failure.status(), failure.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitStatus::Internal, "out of memory; use a shorter recording");
  } catch (const std::exception& failure) {
    return fail(ExitStatus::Internal, failure.what());
  }
}
