#include "view/look/start_view.h"

#include "view/look/limb_bounds.h"

namespace myotact::view {

ViewState start_view(const anatomy::Specimen& specimen, float aspect) {
  ViewState view;
  view.camera = standard_view("lateral", specimen.side != "right", bounds_of(specimen), aspect).value_or(Camera{});
  view.bones.resize(specimen.bones.size());
  view.muscles.resize(specimen.muscles.size());
  return view;
}

}  // namespace myotact::view
