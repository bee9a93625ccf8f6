#include "fuzz/check.h"
#include "fuzz/small_limb.h"
#include "learn/lesson_file.h"
#include "learn/lesson_results.h"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  myotact::testing::small_limb();
  return 0;
}

/// A lesson that is taken can be gone through, whatever it asks for.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  testing::check_reader("f.json", [&] {
    const learn::Lesson lesson =
        learn::parse_lesson(std::string(testing::as_text(data, size)), "f.json", testing::small_limb());
    testing::require(!lesson.steps.empty());
    const anatomy::FactsByKey facts;
    learn::LessonRun run(lesson, testing::small_limb(), facts);
    const messages::SceneFrame frame;
    while (!run.finished()) {
      run.observe({testing::small_limb(), frame, 0.0, {0, -1}});
      run.ask_hint();
      run.choose(0);
      run.type(run.step().title);
      run.predict(learn::Motion::Flexion);
      run.observe({testing::small_limb(), frame, 1.0, {-1, 1}});
      run.go_on();
    }
    testing::require(run.score() >= 0.0 && run.score() <= learn::most_points(lesson));
    testing::require(!learn::results_csv(run).empty());
  });
  return 0;
}
