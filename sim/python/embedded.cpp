#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/embed.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "avoidance/module.h"
#include "sim/plugin/foreign_module.h"

/// The library that runs Python modules in a program without an interpreter. It uses the package in its folder.
namespace py = pybind11;
namespace fs = std::filesystem;

namespace {

#ifdef Py_GIL_DISABLED  // the free-threaded build of a version has packages of its own
constexpr const char* kSuffix = "t";
#else
constexpr const char* kSuffix = "";
#endif
const std::string kVersion = fmt::format("{}.{}{}", PY_MAJOR_VERSION, PY_MINOR_VERSION, kSuffix);

/// Returns the folder of this library, which is that of the package.
fs::path package() {
  Dl_info info{};
  ::dladdr(reinterpret_cast<const void*>(&package), &info);
  return fs::absolute(info.dli_fname).parent_path();
}

/// Returns the versions of Python whose packages a virtual environment has: "3.11" for lib/python3.11/site-packages.
std::vector<std::string> versions_of(const fs::path& environment) {
  constexpr std::string_view kPrefix = "python";
  std::vector<std::string> versions;
  std::error_code error;
  for (const fs::directory_entry& folder : fs::directory_iterator(environment / "lib", error)) {
    const std::string name = folder.path().filename().string();
    if (name.starts_with(kPrefix) && fs::is_directory(folder.path() / "site-packages", error))
      versions.push_back(name.substr(kPrefix.size()));
  }
  std::ranges::sort(versions);
  return versions;
}

/// Returns the interpreter whose packages are used: that of the virtual environment in which pip installed this
/// package, else that of the active one (VIRTUAL_ENV), else that of the build. PATH has no effect. Throws
/// std::invalid_argument if the active environment is of another version.
fs::path interpreter() {
  const fs::path own = package() / "../../../..";  // of <environment>/lib/python3.11/site-packages/hedgehop
  if (fs::exists(own / "pyvenv.cfg")) return (own / "bin/python3").lexically_normal();
  const char* const active = std::getenv("VIRTUAL_ENV");
  if (!active || !*active) return HEDGEHOP_PYTHON;
  const std::vector<std::string> versions = versions_of(active);
  if (std::ranges::find(versions, kVersion) == versions.end()) {
    const std::string found = versions.empty() ? "no Python" : fmt::format("Python {}", fmt::join(versions, " and "));
    throw std::invalid_argument(
        fmt::format("this program was built for Python {0}; the virtual environment {1} (VIRTUAL_ENV) has {2}. Use one "
                    "of Python {0}, or unset VIRTUAL_ENV, or build for the environment: pip install . in the source "
                    "checkout",
                    kVersion, active, found));
  }
  return fs::path(active) / "bin/python3";
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
