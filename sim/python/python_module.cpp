#include <pybind11/stl.h>

#include <algorithm>
#include <utility>

#include "sim/plugin/foreign_module.h"
#include "sim/python/arrays.h"
#include "sim/python/bindings.h"

namespace hedgehop::python {
namespace py = pybind11;
using namespace py::literals;

namespace {

/// What Python raised, in one line: what, then where, the innermost place last.
std::string one_line(const py::error_already_set& error) {
  const py::object traceback = py::module_::import("traceback");
  const py::object lines = traceback.attr("format_exception_only")(error.type(), error.value());
  std::string text = py::str(py::str("").attr("join")(lines).attr("strip")());
  if (error.trace()) {
    for (const py::handle& frame : traceback.attr("extract_tb")(error.trace())) {
      const auto file = py::str(frame.attr("filename")).cast<std::string>();
      if (file.starts_with("<frozen ") || file.ends_with("/hedgehop/_loading.py")) continue;  // not the module's own
      text += " | " + file + ":" + py::str(frame.attr("lineno")).cast<std::string>() + " in " +
              py::str(frame.attr("name")).cast<std::string>();
    }
  }
  std::ranges::replace(text, '\n', ' ');
  return text;
}

/// Calls Python with its lock held.
template <class Call>
auto locked(const Call& call) {
  const py::gil_scoped_acquire lock;
  try {
    return call();
  } catch (const py::error_already_set& error) {
    const std::string what = one_line(error);
    if (error.matches(PyExc_KeyboardInterrupt)) PyErr_SetInterrupt();  // raised again once the call is over
    throw std::runtime_error(what);
  } catch (const py::cast_error& error) {
    throw std::runtime_error(error.what());
  }
}

[[noreturn]] void refuse(const py::handle& value, const std::string& name, const std::string& meant) {
  constexpr size_t kMostLetters = 80;
  std::string got = py::repr(value);
  if (got.size() > kMostLetters) got = got.substr(0, kMostLetters) + "...";
  throw std::runtime_error("'" + name + "' must be " + meant + ", got " + got);
}

/// The value as C++ has it. Throws std::runtime_error saying what it must be and what it is.
template <class T>
T as(const py::handle& value, const std::string& name, const std::string& meant) {
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
    refuse(value, name, meant);
  }
}

class PythonModule : public avoidance::Module {
 public:
  explicit PythonModule(py::object instance) : instance_(std::move(instance)) {
    if (!py::hasattr(instance_, "update")) throw std::invalid_argument("a module's class needs a method update()");
  }
  ~PythonModule() override {
    const py::gil_scoped_acquire lock;
    instance_ = py::object();
  }
  PythonModule(const PythonModule&) = delete;
  PythonModule& operator=(const PythonModule&) = delete;

 private:
  avoidance::Needs do_needs() const override {
    return locked([&] {
      avoidance::Needs needs;
      const py::object given_needs = given("needs", py::list());
      if (py::isinstance<py::str>(given_needs)) refuse(given_needs, "needs", kNeeds);
      for (const py::handle& need : given_needs) needs.cameras.push_back(to_need(need));
      return needs;
    });
  }
  std::vector<avoidance::Signal> do_signals() const override {
    return locked([&] {
      std::vector<avoidance::Signal> signals;
      const py::object announced = given("signals", py::dict());
      if (!py::isinstance<py::dict>(announced)) refuse(announced, "signals", kSignals);
      for (const auto& [name, unit] : py::reinterpret_borrow<py::dict>(announced)) {  // in the class's own order
        if (!py::isinstance<py::str>(name) || !py::isinstance<py::str>(unit)) refuse(announced, "signals", kSignals);
        signals.push_back({name.cast<std::string>(), unit.cast<std::string>()});
      }
      return signals;
    });
  }
  void do_reset(const avoidance::Setup& setup) override {
    locked([&] {
      if (py::hasattr(instance_, "reset")) instance_.attr("reset")(py::cast(setup));
    });
  }
  avoidance::Decision do_update(const avoidance::Observation& observation) override {
    return locked([&] { return to_decision(instance_.attr("update")(to_python(observation))); });
  }
  std::vector<avoidance::Metric> do_metrics() const override {
    return locked([&] {
      std::vector<avoidance::Metric> metrics;
      const auto given_metrics = as<std::map<std::string, double>>(given("metrics", py::dict()), "metrics",
                                                                   "a dict of names and numbers, or return one");
      for (const auto& [name, value] : given_metrics) {
        metrics.push_back({name, value, ""});
      }
      return metrics;
    });
  }
  cv::Mat do_annotate() const override {
    return locked([&]() -> cv::Mat {
      const py::object image = given("annotate", py::none());
      return image.is_none() ? cv::Mat() : rgb_image(image);
    });
  }

  /// What an attribute holds, or what it returns when it can be called.
  py::object given(const char* name, py::object otherwise) const {
    if (!py::hasattr(instance_, name)) return otherwise;
    py::object value = instance_.attr(name);
    return PyCallable_Check(value.ptr()) ? value() : value;
  }
  static avoidance::CameraNeed to_need(const py::handle& need) {
    if (py::isinstance<py::str>(need)) return {need.cast<std::string>()};
    return as<avoidance::CameraNeed>(need, "needs", kNeeds);
  }

  static constexpr const char* kSignals = "a dict of names and units, both texts";
  static constexpr const char* kNeeds = "a list of cameras, each its role or a CameraNeed";

  py::object instance_;
};

std::unique_ptr<avoidance::Module> load(const sim::PythonRequest& request) {
  return locked([&] {
    const py::object loading = py::module_::import("hedgehop._loading");
    return adopt(loading.attr("load_module")(request.file, request.class_name, request.parameters));
  });
}

}  // namespace

std::unique_ptr<avoidance::Module> adopt(py::object instance) {
  return std::make_unique<PythonModule>(std::move(instance));
}

void bind_modules(py::module_& native) {
  sim::set_python_maker(load);
  native.def(
      "_load_module",
      [](std::string file, std::string class_name, std::string parameters) {
        const sim::PythonRequest request{std::move(file), std::move(class_name), std::move(parameters)};
        return reinterpret_cast<uintptr_t>(load(request).release());
      },
      "a module for a program that embeds this interpreter, which owns it from then on");
}

}  // namespace hedgehop::python
