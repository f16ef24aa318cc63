#include <dlfcn.h>
#include <pybind11/embed.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "avoidance/module.h"
#include "sim/plugin/foreign_module.h"

/// The library that runs Python modules in a program without an interpreter. It uses the package in its folder.
namespace py = pybind11;

namespace {

/// Returns the folder of this library, which is that of the package.
std::filesystem::path package() {
  Dl_info info{};
  ::dladdr(reinterpret_cast<const void*>(&package), &info);
  return std::filesystem::absolute(info.dli_fname).parent_path();
}

/// Returns the interpreter whose packages are used: that of the active virtual environment, else that of the build.
/// PATH has no effect.
std::filesystem::path interpreter() {
  if (const char* const environment = std::getenv("VIRTUAL_ENV")) {
    const std::filesystem::path python = std::filesystem::path(environment) / "bin/python3";
    if (std::filesystem::exists(python)) return python;
  }
  return HEDGEHOP_PYTHON;
}

/// Starts the interpreter once. The signal handlers of the program remain.
void start() {
  if (Py_IsInitialized()) return;
  PyConfig config;
  PyConfig_InitPythonConfig(&config);
  config.install_signal_handlers = 0;
  PyConfig_SetBytesString(&config, &config.program_name, interpreter().c_str());
  struct sigaction on_interrupt {};
  ::sigaction(SIGINT, nullptr, &on_interrupt);
  py::initialize_interpreter(&config);
  py::module_::import("signal");  // sets a handler for Ctrl-C in spite of the config
  ::sigaction(SIGINT, &on_interrupt, nullptr);
  const py::module_ sys = py::module_::import("sys");
  sys.attr("path").attr("insert")(0, package().parent_path().string());
  sys.attr("stdout") = sys.attr("stderr");  // standard output is for results only
  py::module_::import("hedgehop._native");
  PyEval_SaveThread();  // from now on, each call acquires the lock
}

/// Returns the text of an exception and of its causes.
std::string words(py::handle raised) {
  const py::object cause = raised.attr("__cause__");
  return py::str(raised).cast<std::string>() + (cause.is_none() ? "" : ": " + words(cause));
}

}  // namespace

/// Creates a module. Throws std::invalid_argument or std::runtime_error with one line.
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
    if (error.matches(PyExc_ValueError)) throw std::invalid_argument(words(error.value()));  // of std::invalid_argument
    throw std::runtime_error(words(error.value()));
  }
}
