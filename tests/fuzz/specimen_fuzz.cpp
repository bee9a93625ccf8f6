#include "anatomy/specimen.h"
#include "core/file.h"
#include "fuzz/check.h"
#include "support/synthetic_specimen.h"
#include "support/temporary_folder.h"

namespace {

/// A folder with the meshes that the texts may name.
const myotact::testing::TemporaryFolder& folder() {
  static const myotact::testing::TemporaryFolder kFolder;
  return kFolder;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  myotact::testing::BarShape shape;
  shape.cells = {1, 1, 1};
  myotact::anatomy::save_specimen(myotact::testing::single_muscle(shape), folder() / "s");
  return 0;
}

/// specimen.json over the meshes of a small specimen.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  try {
    const auto specimen = anatomy::parse_specimen(std::string(testing::as_text(data, size)), folder() / "s");
    testing::require(anatomy::find_defect(specimen).empty());
  } catch (const Error& error) {
    testing::require(error.status() == ExitStatus::BadData || error.status() == ExitStatus::NoInput);
  }
  return 0;
}
