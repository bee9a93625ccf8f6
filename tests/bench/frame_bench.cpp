// What a picture of 1280 x 720 costs without a graphics card: whole, with everything switched on, and of no part at
// all, which is what clearing, anti-aliasing and reading back take by themselves; what is measured once at load;
// picking and the finding of names. Process time counts the renderer's threads; a wish is 16 ms.

#include <string>

#include <benchmark/benchmark.h>

#include "core/data_folder.h"
#include "core/error.h"
#include "view/look/limb_bounds.h"
#include "view/look/picking.h"
#include "view/look/show_options.h"
#include "view/look/start_view.h"
#include "view/overlay/seen_parts.h"
#include "view/pictures/offscreen.h"
#include "view/view_frame.h"

namespace myotact::view {
namespace {

constexpr int kWidth = 1280, kHeight = 720;
constexpr float kAspect = static_cast<float>(kWidth) / static_cast<float>(kHeight);

anatomy::Specimen specimen_of(const std::string& name) {
  return anatomy::load_specimen(data_folder() / "meshes" / name);
}

void frame(benchmark::State& state, const std::string& name, const std::vector<std::string>& show, bool text) {
  const anatomy::Specimen specimen = specimen_of(name);
  const messages::SceneFrame scene = myotact::testing::frame_at_rest(specimen);
  ViewState view = start_view(specimen, kAspect);
  apply_show_options(show, specimen, view);
  try {
    OffscreenRenderer renderer(specimen, kWidth, kHeight);
    for ([[maybe_unused]] auto _ : state) {
      benchmark::DoNotOptimize(text ? renderer.render_with_text(scene, view) : renderer.render(scene, view));
    }
    state.counters["draw_calls"] = renderer.statistics().draw_calls;
    state.counters["uploaded_kB"] = 1e-3 * static_cast<double>(renderer.statistics().uploaded_bytes);
    state.counters["draw_ms"] = renderer.statistics().frame_ms;
  } catch (const Error& error) {
    state.SkipWithError(error.what());
  }
}

void at_load(benchmark::State& state, const std::string& name) {
  const anatomy::Specimen specimen = specimen_of(name);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(shade_limb(specimen));
}

void pick_once(benchmark::State& state, const std::string& name) {
  const anatomy::Specimen specimen = specimen_of(name);
  const messages::SceneFrame scene = myotact::testing::frame_at_rest(specimen);
  const ViewState view = start_view(specimen, kAspect);
  const Ray ray = ray_through(view.camera, 0.5f, 0.3f, kAspect);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(pick(specimen, scene, view, {}, ray));
}

void find_names(benchmark::State& state, const std::string& name) {
  const anatomy::Specimen specimen = specimen_of(name);
  const messages::SceneFrame scene = myotact::testing::frame_at_rest(specimen);
  const ViewState view = start_view(specimen, kAspect);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(seen_parts(specimen, scene, view, {}, kAspect));
}

void declare() {
  const auto in_ms = [](benchmark::internal::Benchmark* entry) {
    entry->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
  };
  for (const std::string name : {"canine_elbow", "canine_forelimb"}) {
    const auto add = [&](const char* what, const std::vector<std::string>& show, bool text) {
      in_ms(benchmark::RegisterBenchmark((name + "/" + what).c_str(), frame, name, show, text));
    };
    add("nothing", {"layers=none", "lines=off"}, false);
    add("limb", {}, false);
    add("limb_without_lines", {"lines=off"}, false);
    add("limb_named", {"labels=on"}, true);
    add("everything", {"labels=on", "fibres=on", "attachments=on", "section=left:0.7"}, true);
    in_ms(benchmark::RegisterBenchmark((name + "/at_load").c_str(), at_load, name));
    in_ms(benchmark::RegisterBenchmark((name + "/pick").c_str(), pick_once, name));
    in_ms(benchmark::RegisterBenchmark((name + "/find_names").c_str(), find_names, name));
  }
}

}  // namespace
}  // namespace myotact::view

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  myotact::view::declare();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
