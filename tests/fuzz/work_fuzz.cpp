#include "fuzz/check.h"
#include "fuzz/small_limb.h"
#include "view/look/start_view.h"
#include "view/session/saved_work.h"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  myotact::testing::small_limb();
  return 0;
}

/// A saved work that is taken can be shown, and is the same when it is written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  testing::check_reader("f.json", [&] {
    const view::SavedWork work = view::parse_work(std::string(testing::as_text(data, size)), "f.json");
    view::ViewState shown = view::start_view(testing::small_limb(), 1.0f);
    view::show(work.view, testing::small_limb(), shown);
    testing::require(shown.muscles.size() == testing::small_limb().muscles.size());
    for (const int muscle : shown.plotted_muscles) testing::require(muscle >= 0 && muscle < 2);
    testing::require(view::parse_work(view::work_text(work), "f.json") == work);
    const view::JoinedMarks both = view::joined(work.marks, work.marks);
    testing::require(both.marks == work.marks && both.differing_notes == 0);
  });
  return 0;
}
