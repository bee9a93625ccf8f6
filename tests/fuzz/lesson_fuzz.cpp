#include "fuzz/check.h"
#include "learn/lesson_file.h"
#include "learn/lesson_results.h"
#include "support/synthetic_specimen.h"

namespace {

const myotact::anatomy::Specimen& specimen() {
  static const myotact::anatomy::Specimen kSpecimen = myotact::testing::antagonist_hinge();
  return kSpecimen;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  specimen();
  return 0;
}

/// A lesson that is taken can be gone through, whatever it asks for.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  testing::check_reader("f.json", [&] {
    const learn::Lesson lesson = learn::parse_lesson(std::string(testing::as_text(data, size)), "f.json", specimen());
    testing::require(!lesson.steps.empty());
    const anatomy::FactsByKey facts;
    learn::LessonRun run(lesson, specimen(), facts);
    const messages::SceneFrame frame;
    while (!run.finished()) {
      run.observe({specimen(), frame, 0.0, {0, -1}});
      run.ask_hint();
      run.choose(0);
      run.type(run.step().title);
      run.predict(learn::Motion::Flexion);
      run.observe({specimen(), frame, 1.0, {-1, 1}});
      run.go_on();
    }
    testing::require(run.score() >= 0.0 && run.score() <= learn::most_points(lesson));
    testing::require(!learn::results_csv(run).empty());
  });
  return 0;
}
