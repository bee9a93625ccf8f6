#pragma once

#include <gtest/gtest.h>

#include "support/synthetic_specimen.h"
#include "view/look/start_view.h"
#include "view/panels/panel.h"
#include "view/unseen_window.h"
#include "view/view_frame.h"

namespace myotact::testing {

/// An antagonist hinge at rest in a window that nobody sees, with all that panels and the mouse read and change.
class HingeWindow : public ::testing::Test {
 protected:
  /// `aspect`: of the scene, width over height.
  explicit HingeWindow(float aspect) : view_(view::start_view(specimen_, aspect)) {}

  /// Nothing hovered, no film.
  view::PanelContext context() {
    return {specimen_, frame_, facts_, readings_, news_,  part_facts_, marks_,
            {},        false,  view_,  controls_, scene_, asks_};
  }

  UnseenWindow window_;
  anatomy::Specimen specimen_ = antagonist_hinge();
  messages::SceneFrame frame_ = frame_at_rest(specimen_);
  view::SceneFacts facts_;
  view::JointReadings readings_;
  view::SessionNews news_;
  anatomy::FactsByKey part_facts_;
  view::Marks marks_;
  view::ViewState view_;
  view::ViewControls controls_;
  view::SceneControls scene_{{}};
  view::WindowAsks asks_;
};

}  // namespace myotact::testing
