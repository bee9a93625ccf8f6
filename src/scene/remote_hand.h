#pragma once

#include <array>

#include "anatomy/specimen.h"
#include "messages/local_model.h"
#include "messages/remote_hand.h"
#include "messages/tool_state.h"
#include "realtime/latest_value.h"

namespace myotact::scene {

/// A hand whose haptic loop runs elsewhere: the simulation's ends of its channels. A state with sequence 0 means that
/// the hand is free.
struct RemoteHand {
  realtime::LatestValue<messages::ToolState>* states = nullptr;   // read
  realtime::LatestValue<messages::LocalModel>* models = nullptr;  // written
  realtime::LatestValue<messages::HandForce>* forces = nullptr;   // written
};

/// The state of a remote hand, as far as the specimen has what it names; one that names something else, or nothing at
/// all, lets go. Its indices are good to look things up from here on.
messages::ToolState heeded(const messages::ToolState& received, const anatomy::Specimen& specimen);

/// Of all springs between the hand and the scene, as the model has them at the end of its step [N, on the hand]: for
/// clients that have no haptic loop of their own.
std::array<double, 3> force_on_hand_N(const messages::LocalModel& model, const messages::ToolState& tool);

}  // namespace myotact::scene
