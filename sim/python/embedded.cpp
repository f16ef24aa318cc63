#include <dlfcn.h>
#include <pybind11/embed.h>

#include <filesystem>
#include <stdexcept>

#include "avoidance/module.h"
#include "sim/plugin/python_module.h"

/// The library through which a program without an interpreter flies modules in Python. The package beside it does the
/// work.
namespace py = pybind11;

namespace {

/// Folder of this library, which is the package's.
std::filesystem::path package() {
  Dl_info info{};
  ::dladdr(reinterpret_cast<const void*>(&package), &info);
  return std::filesystem::absolute(info.dli_fname).parent_path();
}

/// Starts the interpreter, once; it ends with the program. Signals stay the program's.
void start() {
  if (Py_IsInitialized()) return;
  py::initialize_interpreter(/*init_signal_handlers=*/false);
  py::module_::import("sys").attr("path").attr("insert")(0, package().parent_path().string());
  py::module_::import("hedgehop._native");
  PyEval_SaveThread();  // from here on whoever calls takes the lock
}

}  // namespace

/// Throws std::runtime_error with one line.
extern "C" __attribute__((visibility("default"))) hedgehop::avoidance::Module* hedgehop_make_python_module(
    const hedgehop::sim::PythonRequest& request) {
  try {
    start();
    const py::gil_scoped_acquire lock;
    const py::object address = py::module_::import("hedgehop._native")
                                   .attr("_load_module")(request.file, request.class_name, request.parameters);
    return reinterpret_cast<hedgehop::avoidance::Module*>(address.cast<uintptr_t>());
  } catch (const py::error_already_set& error) {
    const py::gil_scoped_acquire lock;
    throw std::runtime_error(py::str(error.value()).cast<std::string>());
  }
}
