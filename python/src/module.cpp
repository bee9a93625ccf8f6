#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "binding.h"
#include "core/data_folder.h"
#include "core/error.h"
#include "core/log.h"
#include "core/text.h"
#include "gil.h"
#include "scene/scene_file.h"

namespace myotact::python {

namespace {

constexpr int kMisused = -1;  // in the place of an exit status, see myotact/errors.py

/// The exception is made by Python, where its classes are.
void raise(int status, const char* text) {
  const py::object made = py::module_::import("myotact.errors").attr("_made")(status, text);
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(made.ptr())), made.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const Error& failure) {
    raise(static_cast<int>(failure.status()), failure.what());
  } catch (const Misuse& failure) {
    raise(kMisused, failure.what());
  }
}

}  // namespace

}  // namespace myotact::python

PYBIND11_MODULE(_myotact, module) {
  namespace py = pybind11;
  using namespace myotact;
  module.doc() = "What of myotact is not Python. Use the package myotact.";
  start_log("warning");
  py::register_exception_translator(python::translate);
  py::module_::import("atexit").attr("register")(py::cpp_function(python::end_work));
  module.attr("version") = MYOTACT_VERSION;
  module.def("suggest_data_folder", [](const std::string& folder) { suggest_data_folder(folder); });
  module.def("data_folder", [] { return data_folder().string(); });
  module.def("built_in_scenes", &scene::built_in_scenes);
  module.def("start_log", &start_log);
  module.def("nearest_word", [](const std::string& word, const std::vector<std::string>& candidates) {
    return nearest_word(word, candidates);
  });
  python::bind_specimen(module);
  python::bind_scene(module);
  python::bind_measure(module);
}
