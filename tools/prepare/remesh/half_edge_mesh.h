#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "core/vector.h"

namespace myotact::prepare {

/// Metres in double: the default float traits lose needles of a nanometre and anything far from the origin.
struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

inline Vec3 to_vec3(const OpenMesh::Vec3d& p) {
  return {p[0], p[1], p[2]};
}
inline OpenMesh::Vec3d to_openmesh(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

}  // namespace myotact::prepare
