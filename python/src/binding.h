#pragma once

#include <pybind11/pybind11.h>

// The parts of the extension module; each adds what its file is named after. module.cpp calls them.

namespace myotact::python {

void bind_specimen(pybind11::module_& module);
void bind_scene(pybind11::module_& module);  // after bind_specimen
void bind_measure(pybind11::module_& module);

}  // namespace myotact::python
