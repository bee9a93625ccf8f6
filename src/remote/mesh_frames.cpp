#include "remote/mesh_frames.h"

#include <spdlog/spdlog.h>

#include "net/byte_cursor.h"

namespace myotact::remote {

namespace {

enum class Kind : std::uint8_t { Skin, Bone };

net::Bytes mesh_frame(Kind kind, std::size_t index, int body, const geometry::TriangleMesh& mesh) {
  net::Bytes bytes;
  net::ByteWriter out(bytes);
  out.put(static_cast<std::uint8_t>(kind));
  out.put(static_cast<std::uint16_t>(index));
  out.put(static_cast<std::int32_t>(body));
  out.put(static_cast<std::uint32_t>(mesh.positions_m.size()));
  out.put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Vec3& position : mesh.positions_m) {
    for (int axis = 0; axis < 3; ++axis) out.put(static_cast<float>(position[axis]));
  }
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) out.put(static_cast<std::uint32_t>(corner));
  }
  return bytes;
}

}  // namespace

std::vector<net::Bytes> mesh_frames(const anatomy::Specimen& specimen) {
  std::vector<net::Bytes> frames;
  const auto add = [&](net::Bytes frame, const std::string& key) {
    if (frame.size() <= net::kMostPayload) {
      frames.push_back(std::move(frame));
    } else {
      spdlog::warn("{}: its mesh of {} bytes does not fit into a frame; clients without the files miss it", key,
                   frame.size());
    }
  };
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
    add(mesh_frame(Kind::Skin, m, -1, specimen.muscles[m].skin), specimen.muscles[m].key);
  }
  for (std::size_t b = 0; b < specimen.bones.size(); ++b) {
    add(mesh_frame(Kind::Bone, b, specimen.bones[b].body, specimen.bones[b].surface), specimen.bones[b].key);
  }
  return frames;
}

}  // namespace myotact::remote
