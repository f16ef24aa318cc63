#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/config/input_error.h"
#include "sim/fields/shortened.h"
#include "sim/flight/build.h"
#include "sim/plugin/foreign_module.h"
#include "sim/python/bindings.h"

namespace hedgehop::python {
namespace py = pybind11;
using namespace py::literals;

namespace {

/// Returns the message of a Python exception; that of a syntax error begins with its file and line.
std::string message_of(const py::error_already_set& error) {
  const py::object value = error.value();
  if (error.matches(PyExc_SyntaxError) && !value.attr("lineno").is_none()) {
    return py::str("{}:{}: {}: {}")
        .format(value.attr("filename"), value.attr("lineno"), error.type().attr("__name__"), value.attr("msg"));
  }
  const py::object lines = py::module_::import("traceback").attr("format_exception_only")(error.type(), value);
  std::string text = py::str(py::str("").attr("join")(lines).attr("strip")());
  constexpr std::string_view kRefusal = "hedgehop._loading.Refusal: ";  // its text is a whole message
  return text.starts_with(kRefusal) ? text.substr(kRefusal.size()) : text;
}

/// Returns a Python exception in one line: the message, then the places, innermost last.
std::string one_line(const py::error_already_set& error) {
  const py::object traceback = py::module_::import("traceback");
  std::string text = message_of(error);
  if (error.trace()) {
    for (const py::handle& frame : traceback.attr("extract_tb")(error.trace())) {
      const auto file = py::str(frame.attr("filename")).cast<std::string>();
      if (file.starts_with("<frozen ") || file.ends_with("/hedgehop/_loading.py")) continue;  // not part of the module
      text += " | " + file + ":" + py::str(frame.attr("lineno")).cast<std::string>() + " in " +
              py::str(frame.attr("name")).cast<std::string>();
    }
  }
  std::ranges::replace(text, '\n', ' ');
  return text;
}

/// Returns an attribute, or a null object if there is none. Throws the exception of a property, unlike
/// hasattr().
py::object find_attribute(const py::object& object, const char* name) {
  if (PyObject* const found = PyObject_GetAttrString(object.ptr(), name))
    return py::reinterpret_steal<py::object>(found);
  const py::error_already_set error;
  const py::object absent = py::none();
  const py::object known = py::module_::import("inspect").attr("getattr_static")(object, name, absent);
  if (!error.matches(PyExc_AttributeError) || !known.is(absent)) throw error;
  return {};
}

/// Whether an exception means that the module cannot be used as it is configured, and is no failure of a call.
bool is_refusal(const py::error_already_set& error) {
  return error.matches(PyExc_ValueError) || error.matches(PyExc_TypeError) || error.matches(PyExc_SyntaxError) ||
         error.matches(PyExc_ImportError) || error.matches(PyExc_OSError);
}

/// Calls Python with the lock of the interpreter. An exception of Python becomes std::invalid_argument if it is a
/// refusal, else std::runtime_error, with its text.
template <class Call>
auto locked(const Call& call) {
  const py::gil_scoped_acquire lock;
  try {
    return call();
  } catch (const py::error_already_set& error) {
    const std::string message = one_line(error);
    if (error.matches(PyExc_KeyboardInterrupt)) PyErr_SetInterrupt();  // raised again after the call
    if (is_refusal(error)) throw std::invalid_argument(message);
    throw std::runtime_error(message);
  } catch (const py::cast_error& error) {
    throw std::invalid_argument(error.what());
  }
}

[[noreturn]] void refuse(const py::handle& value, const std::string& name, const std::string& expected) {
  constexpr size_t kMaxBytes = 80;
  const std::string got = py::repr(value);
  throw std::invalid_argument("'" + name + "' must be " + expected + ", got " + shortened(got, kMaxBytes));
}

/// Returns the value as a C++ type. Throws std::invalid_argument with the expected and the actual value.
template <class T>
T as(const py::handle& value, const std::string& name, const std::string& expected) {
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
    refuse(value, name, expected);
  }
}

class PythonModule : public avoidance::Module {
 public:
  explicit PythonModule(py::object instance) : instance_(std::move(instance)) {
    if (!find_attribute(instance_, "update"))
      throw std::invalid_argument("the class of a module needs a method update()");
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
      const bool is_text = py::isinstance<py::str>(given_needs);
      if (is_text || !py::isinstance<py::iterable>(given_needs)) refuse(given_needs, "needs", kNeeds);
      for (const py::handle& need : given_needs) needs.cameras.push_back(to_need(need));
      for (const std::string& type :
           as<std::vector<std::string>>(given("commands", py::list()), "commands", kCommands)) {
        needs.commands.push_back(to_type(type));
      }
      return needs;
    });
  }
  std::vector<avoidance::Signal> do_signals() const override {
    return locked([&] {
      std::vector<avoidance::Signal> signals;
      const py::object announced = given("signals", py::dict());
      if (!py::isinstance<py::dict>(announced)) refuse(announced, "signals", kSignals);
      for (const auto& [name, unit] : py::reinterpret_borrow<py::dict>(announced)) {  // in the order of the class
        if (!py::isinstance<py::str>(name) || !py::isinstance<py::str>(unit)) refuse(announced, "signals", kSignals);
        signals.push_back({name.cast<std::string>(), unit.cast<std::string>()});
      }
      return signals;
    });
  }
  void do_reset(const avoidance::Setup& setup) override {
    locked([&] {
      if (const py::object reset = find_attribute(instance_, "reset")) reset(py::cast(setup));
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

  /// Returns the value of an attribute, or its return value if it is callable.
  py::object given(const char* name, py::object otherwise) const {
    py::object value = find_attribute(instance_, name);
    if (!value) return otherwise;
    return PyCallable_Check(value.ptr()) ? value() : value;
  }
  static avoidance::CameraNeed to_need(const py::handle& need) {
    if (py::isinstance<py::str>(need)) return {need.cast<std::string>()};
    return as<avoidance::CameraNeed>(need, "needs", kNeeds);
  }

  avoidance::CommandType to_type(const std::string& type) const {
    const auto found = std::ranges::find(kTypes, type);
    if (found == kTypes.end()) refuse(instance_.attr("commands"), "commands", kCommands);
    return static_cast<avoidance::CommandType>(found - kTypes.begin());
  }

  static constexpr std::array<std::string_view, 4> kTypes = {"velocity", "position", "attitude", "hover"};
  static constexpr const char* kCommands = "a list of command types: velocity, position, attitude, hover";
  static constexpr const char* kSignals = "a dict of names and units, both texts";
  static constexpr const char* kNeeds = "a list of cameras, each its role or a CameraNeed";

  py::object instance_;
};

std::unique_ptr<avoidance::Module> load(const sim::PythonRequest& request) {
  return locked([&] {
    const py::object loading = py::module_::import("hedgehop._loading");
    return wrap_python_object(loading.attr("load_module")(request.file, request.class_name, request.parameters));
  });
}

}  // namespace

std::unique_ptr<avoidance::Module> wrap_python_object(py::object instance) {
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
      "Returns a module for a program that embeds this interpreter; the program owns the module.");
}

}  // namespace hedgehop::python

PYBIND11_MODULE(_native, native) {
  namespace py = pybind11;
  native.doc() = "The C++ part of hedgehop; use the names of the package.";
  py::register_exception<hedgehop::sim::InputError>(native, "InputError", PyExc_ValueError).doc() =
      "Invalid input: one line per fault, as printed by `hedgehop run`.";
  native.attr("version") = std::string(hedgehop::sim::version());
  native.attr("build") = std::string(hedgehop::sim::build_identity());
  hedgehop::python::bind_states(native);
  hedgehop::python::bind_modules(native);
  hedgehop::python::bind_simulation(native);
}
