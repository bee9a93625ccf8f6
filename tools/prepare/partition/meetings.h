#pragma once

#include <algorithm>
#include <cstdint>

#include <boost/container/small_vector.hpp>

#include "core/at.h"
#include "prepare/partition/interfaces.h"

namespace myotact::prepare {

// Which parts come together at a vertex or an edge of interfaces, told by the faces around it.

/// Labels that meet at a vertex or an edge, rising.
using Meeting = boost::container::small_vector<std::uint16_t, 8>;
/// Numbers of vertices or faces around a place.
using Indices = boost::container::small_vector<int, 24>;

/// On both sides of the faces.
template <class Faces>
Meeting labels_of(const Interfaces& interfaces, const Faces& faces) {
  Meeting labels;
  for (const int f : faces) {
    for (const std::uint16_t label : {interfaces.faces[at(f)].inner, interfaces.faces[at(f)].outer}) {
      if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
    }
  }
  std::sort(labels.begin(), labels.end());
  return labels;
}

/// Those of `faces` that have the vertex.
template <class Faces>
Indices faces_with(const Interfaces& interfaces, const Faces& faces, int vertex) {
  Indices found;
  for (const int f : faces) {
    const auto& v = interfaces.faces[at(f)].vertices;
    if (std::find(v.begin(), v.end(), vertex) != v.end()) found.push_back(f);
  }
  return found;
}

/// The other vertices of the faces around one, rising.
template <class Faces>
Indices neighbours_of(const Interfaces& interfaces, const Faces& faces, int vertex) {
  Indices around;
  for (const int f : faces) {
    for (const int v : interfaces.faces[at(f)].vertices) {
      if (v != vertex) around.push_back(v);
    }
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  return around;
}

}  // namespace myotact::prepare
