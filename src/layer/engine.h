#pragma once

#include <string_view>

#include "core/pose.h"
#include "messages/local_model.h"
#include "messages/tool_state.h"

namespace myotact::layer {

/// What the layer asks of a physics engine, however slow: an adapter of a few functions. All calls from one thread.
/// Surfaces are numbered 0 .. surface_count() - 1 as in LocalModel; tools 0, 1, .. as in the layer.
class Engine {
 public:
  virtual ~Engine() = default;

  virtual std::string_view name() const = 0;  // "myotact", "bullet"
  virtual double step_s() const = 0;          // of advance()
  virtual int surface_count() const = 0;

  /// Puts the body of a tool where the state has the tool; the state's springs (contact, bone in hand) pull at the
  /// scene during the steps that follow, until the next state. The body itself pushes nothing: a tool that pushed as
  /// well as pulled would act twice.
  virtual void move_tool(int tool, const messages::ToolState& state) = 0;
  virtual void advance() = 0;
  /// What the engine's collision detection reports of the tool now; may be invalid, which the layer takes out.
  virtual void report_contacts(int tool, messages::ReportedContacts& reported) const = 0;
  /// X_WL of the body of a surface: maps its place at the start to now. Identity for what has no pose (tissue).
  virtual Pose body_pose(int surface) const = 0;
  /// Fills surface, coverage and grip of a model: the triangles near the tool at the last two steps, and the bone
  /// nearest to it or in its hand. An engine that leaves them empty is felt by the force methods that go by reports.
  virtual void write_surface(int tool, messages::LocalModel& model) const = 0;
};

}  // namespace myotact::layer
