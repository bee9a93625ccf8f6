#pragma once

#include "view/look/part.h"

namespace myotact::view {

// What a person does with a part, by click, key or menu. Undo goes back over all of it.

void select(ViewState& view, const Part& part);  // no part: nothing is selected
/// Shows this part alone among its kind: of muscles all others hidden, bones faded; of bones all others hidden, muscles
/// faded. Once more: everything again.
void isolate(ViewState& view, const Part& part);
bool is_isolated(const ViewState& view, const Part& part);
void show_all(ViewState& view);
PartLook& look_of(ViewState& view, const Part& part);  // of a part that is there
/// Into the plots, or out of them.
void toggle_plot(ViewState& view, int muscle);
bool is_plotted(const ViewState& view, int muscle);

}  // namespace myotact::view
