#pragma once

#include <array>
#include <memory>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "core/vector.h"

namespace myotact::python {

namespace py = pybind11;

/// A read-only numpy array over memory of ours, `columns` wide; one column: flat. `owner` lives as long as the array
/// does.
template <class Number, class Owner>
py::array_t<Number> view_of(const Number* numbers, std::size_t rows, std::size_t columns,
                            std::shared_ptr<Owner> owner) {
  using Kept = std::shared_ptr<Owner>;
  const py::capsule kept(new Kept(std::move(owner)), [](void* held) { delete static_cast<Kept*>(held); });
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(rows)};
  if (columns > 1) shape.push_back(static_cast<py::ssize_t>(columns));
  py::array_t<Number> array(shape, numbers, kept);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// Of points: rows x 3.
template <class Owner>
py::array_t<double> view_of(const std::vector<Vec3>& points, std::shared_ptr<Owner> owner) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return view_of(points.empty() ? nullptr : points.front().data(), points.size(), 3, std::move(owner));
}

/// Of corner lists: rows x Corners.
template <std::size_t Corners, class Owner>
py::array_t<int> view_of(const std::vector<std::array<int, Corners>>& lists, std::shared_ptr<Owner> owner) {
  return view_of(lists.empty() ? nullptr : lists.front().data(), lists.size(), Corners, std::move(owner));
}

inline py::tuple tuple_of(const Vec3& v) {
  return py::make_tuple(v.x(), v.y(), v.z());
}

/// Throws IndexError: the module's Python part looks names up, so that a wrong index is a slip of whoever goes past it.
inline void require_index(const char* what, int index, std::size_t count) {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return;
  throw py::index_error(std::string(what) + " " + std::to_string(index) + ": must be in 0 .. " +
                        std::to_string(static_cast<long>(count) - 1));
}

}  // namespace myotact::python
