#include "fuzz/check.h"
#include "view/session/marks.h"

/// Marks that are taken keep their limits, and are the same when they are written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  testing::check_reader("f.json", [&] {
    const view::Marks marks = view::parse_marks(std::string(testing::as_text(data, size)), "f.json");
    for (const auto& [part, text] : marks.notes) testing::require(view::characters_in(text) <= view::kLongestNote);
    for (const auto& bookmark : marks.bookmarks) {
      testing::require(view::characters_in(bookmark.name) <= view::kLongestName);
    }
    testing::require(view::parse_marks(view::marks_text(marks, "limb"), "f.json") == marks);
  });
  return 0;
}
