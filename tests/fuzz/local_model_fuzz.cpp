#include <algorithm>

#include "fuzz/check.h"
#include "net/local_model_codec.h"

// What decodes is what encodes to the same bytes, with every index in range.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  static messages::LocalModel model;
  if (!net::decode({data, size}, model)) return 0;
  for (std::int32_t t = 0; t < model.triangle_count; ++t) {
    for (const std::int32_t vertex : model.triangles[static_cast<std::size_t>(t)].vertices) {
      testing::require(vertex >= 0 && vertex < model.vertex_count);
    }
  }
  static net::Bytes again;
  net::encode(model, again);
  testing::require(std::equal(again.begin(), again.end(), data, data + size));
  return 0;
}
