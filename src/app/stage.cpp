#include "app/stage.h"

#include "app/live_stage.h"
#include "app/mirror_stage.h"
#include "app/replay_stage.h"

namespace myotact::app {

std::unique_ptr<Stage> make_stage(const Options& options, GuardedMotors& guarded, const Equipment& equipment) {
  if (options.connect) return std::make_unique<MirrorStage>(options);
  if (options.recording) return std::make_unique<ReplayStage>(options);
  return std::make_unique<LiveStage>(options, guarded, equipment);
}

}  // namespace myotact::app
