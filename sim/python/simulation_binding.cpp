#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include "sim/flight/build.h"
#include "sim/flight/words.h"
#include "sim/python/bindings.h"
#include "sim/record/flight_columns.h"
#include "sim/record/labels_file.h"
#include "sim/record/result_files.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::python {
namespace py = pybind11;
using namespace py::literals;

namespace {

sim::ImageChannel to_channel(const std::string& name) {
  using enum sim::ImageChannel;
  static constexpr std::pair<std::string_view, sim::ImageChannel> kChannels[] = {
      {"grey", grey}, {"color", color}, {"depth", depth}, {"labels", labels}, {"semantic", semantic}};
  for (const auto& [known, channel] : kChannels) {
    if (known == name) return channel;
  }
  throw std::invalid_argument("channel '" + name + "'; allowed: grey, color, depth, labels, semantic");
}

/// @param quaternion  of the body to the world, w x y z.
sim::ChosenPose chosen_pose(const Eigen::Vector3d& position_m, const Eigen::Vector4d& quaternion, double t_s) {
  const Eigen::Quaterniond q_WB(quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
  constexpr double kMaxError = 1e-3;
  if (!(std::abs(q_WB.norm() - 1.0) <= kMaxError)) throw std::invalid_argument("a quaternion must have length 1");
  sim::ChosenPose pose{.t_s = t_s};
  pose.X_WB.linear() = q_WB.normalized().toRotationMatrix();
  pose.X_WB.translation() = position_m;
  return pose;
}

/// A simulation and its thread. Other threads are not blocked while it flies.
class PySimulation {
 public:
  PySimulation(sim::LoadedScenario loaded, std::string file, std::vector<std::string> overrides,
               sim::ModuleMaker module)
      : file_(std::move(file)),
        overrides_(std::move(overrides)),
        inputs_(loaded.inputs),
        is_steered_(module != nullptr) {
    loaded.scenario.film.enabled = false;
    const py::gil_scoped_release unlocked;
    if (module) {
      simulation_.emplace(std::move(loaded.scenario), std::move(module));
    } else {
      simulation_.emplace(std::move(loaded));
    }
  }

  sim::Simulation& get() {
    if (std::this_thread::get_id() != thread_) {
      throw std::runtime_error("a Simulation can be used only by the thread that created it; create one per thread");
    }
    return *simulation_;
  }

  Observation reset(std::optional<uint64_t> seed, std::optional<uint64_t> world_seed) {
    unlocked([&](sim::Simulation& s) {
      s.reset(seed.value_or(s.scenario().seed), world_seed ? world_seed : s.scenario().world_seed);
    });
    return seen();
  }
  Observation seen() { return to_python(get().seen()); }

  Observation step(const py::object& command) {
    fly(
        command, [](sim::Simulation& s) { s.step(); }, [](sim::Simulation& s, const auto& c) { s.step(c); });
    return seen();
  }
  Observation tick(const py::object& command) {
    fly(
        command, [](sim::Simulation& s) { s.tick(); }, [](sim::Simulation& s, const auto& c) { s.tick(c); });
    return seen();
  }
  /// Flies to the end. Ctrl-C is handled between two decisions.
  void run_through() {
    while (!get().over()) unlocked([](sim::Simulation& s) { s.step(); });
  }
  std::string run_json() {
    run_through();
    return result_json();
  }

  std::string result_json() {
    const sim::Flight& flight = judged();
    return sim::result_json(info(), flight.result);
  }
  void save(const std::filesystem::path& folder) { sim::write_result_files(folder, info(), judged()); }
  std::string trajectory_csv() { return sim::trajectory_csv(judged()); }
  std::string decisions_csv() { return sim::decisions_csv(judged()); }

  const std::string& file() const { return file_; }
  py::list checks_so_far() {
    py::list checks;
    for (const sim::CheckResult& c : get().checks_so_far()) {
      checks.append(py::dict("name"_a = c.name, "passed"_a = c.passed, "value"_a = c.value, "limit"_a = c.limit,
                             "unit"_a = c.unit, "must"_a = std::string(c.must), "t_s"_a = c.t_s));
    }
    return checks;
  }

 private:
  template <class Call>
  void unlocked(const Call& call) {
    sim::Simulation& simulation = get();
    judged_.reset();
    {
      const py::gil_scoped_release release;
      call(simulation);
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  template <class Plain, class Commanded>
  void fly(const py::object& command, const Plain& plain, const Commanded& commanded) {
    if (get().over()) throw std::runtime_error("the flight is over; reset() starts a new one");
    if (command.is_none()) {
      unlocked(plain);
    } else {
      is_steered_ = true;
      const sim::CallerCommand given = to_caller_command(command);
      unlocked([&](sim::Simulation& s) { commanded(s, given); });
    }
  }

  const sim::Flight& judged() {
    if (!get().over()) throw std::runtime_error("the flight is not over; run() completes it");
    if (!judged_) judged_ = get().result();
    return *judged_;
  }
  sim::RunInfo info() {
    const sim::Scenario& scenario = get().scenario();
    std::string line = fmt::format("hedgehop run {} --seed {}", sim::shell_quoted(file_), scenario.seed);
    for (const std::string& text : overrides_) line += " --set " + sim::shell_quoted(text);
    if (is_steered_) line += " # but controlled from Python";
    return {scenario.name, scenario.seed, std::string(sim::version()), std::string(sim::build_identity()), inputs_,
            file_,         line,          sim::to_yaml(scenario)};
  }

  std::string file_;
  std::vector<std::string> overrides_;
  sim::Inputs inputs_;
  bool is_steered_;  ///< whether a module or commands come from Python
  std::optional<sim::Simulation> simulation_;
  std::optional<sim::Flight> judged_;
  std::thread::id thread_ = std::this_thread::get_id();
};

/// @param module   a class (a new object for each flight), an object, or None.
/// @param cameras  roles of the images if no module flies; None for the cameras of the module.
std::unique_ptr<PySimulation> make(const std::optional<std::string>& file, const std::optional<std::string>& text,
                                   std::optional<uint64_t> seed, std::vector<std::string> overrides,
                                   const py::object& module, const std::optional<std::vector<std::string>>& cameras) {
  if (file.has_value() == text.has_value())
    throw std::invalid_argument("give either the file of the scenario or its text");
  if (!module.is_none() && cameras)
    throw std::invalid_argument("give either a module, which names its cameras, or cameras");
  sim::LoadedScenario loaded =
      file ? sim::load_flight(*file, overrides, seed) : sim::load_flight_text(*text, overrides, seed);
  sim::ModuleMaker maker;
  if (cameras) maker = sim::hovering(loaded.scenario.rig, *cameras);
  if (!module.is_none()) {
    maker = [module] {
      const py::gil_scoped_acquire lock;
      return wrap_python_object(PyType_Check(module.ptr()) ? module() : module);
    };
  }
  return std::make_unique<PySimulation>(std::move(loaded), file.value_or("scenario text"), std::move(overrides),
                                        std::move(maker));
}

}  // namespace

void bind_simulation(py::module_& native) {
  py::class_<PySimulation>(native, "Simulation")
      .def(py::init(&make), "file"_a, "text"_a, "seed"_a, "overrides"_a, "module"_a, "cameras"_a)
      .def("reset", &PySimulation::reset, "seed"_a, "world_seed"_a)
      .def("step", &PySimulation::step, "command"_a)
      .def("tick", &PySimulation::tick, "command"_a)
      .def("run_through", &PySimulation::run_through)
      .def("run_json", &PySimulation::run_json)
      .def("result_json", &PySimulation::result_json)
      .def("save", &PySimulation::save, "folder"_a)
      .def("trajectory_csv", &PySimulation::trajectory_csv)
      .def("decisions_csv", &PySimulation::decisions_csv)
      .def("checks_so_far", &PySimulation::checks_so_far)
      .def("file", &PySimulation::file)
      .def("seen", &PySimulation::seen)
      .def("truth", [](PySimulation& s) { return s.get().truth(); })
      .def("proximity", [](PySimulation& s) { return s.get().proximity(); })
      .def(
          "camera", [](PySimulation& s, const std::string& role) { return s.get().camera(role); }, "role"_a)
      .def("roles",
           [](PySimulation& s) {
             std::vector<std::string> roles;
             for (const auto& camera : s.get().scenario().rig.cameras) roles.push_back(camera.role);
             return roles;
           })
      .def(
          "image",
          [](PySimulation& s, const std::string& role, const std::string& channel) {
            return view_of(s.get().image(role, to_channel(channel)));
          },
          "role"_a, "channel"_a)
      .def(
          "flow_to_next_image",
          [](PySimulation& s, const std::string& role) { return view_of(s.get().flow_to_next_image(role)); }, "role"_a)
      .def(
          "image_from",
          [](PySimulation& s, const std::string& role, const std::string& channel, const Eigen::Vector3d& position,
             const Eigen::Vector4d& quaternion, double t_s) {
            return view_of(s.get().image_from(role, to_channel(channel), chosen_pose(position, quaternion, t_s)));
          },
          "role"_a, "channel"_a, "position"_a, "quaternion"_a, "t_s"_a = 0.0)
      .def(
          "proximity_from",
          [](PySimulation& s, const Eigen::Vector3d& position, const Eigen::Vector4d& quaternion, double t_s) {
            return s.get().proximity_from(chosen_pose(position, quaternion, t_s));
          },
          "position"_a, "quaternion"_a, "t_s"_a = 0.0)
      .def(
          "flow_between",
          [](PySimulation& s, const std::string& role, const std::pair<Eigen::Vector3d, Eigen::Vector4d>& from,
             const std::pair<Eigen::Vector3d, Eigen::Vector4d>& to, double from_s, double to_s) {
            return view_of(s.get().flow_between(role, chosen_pose(from.first, from.second, from_s),
                                                chosen_pose(to.first, to.second, to_s)));
          },
          "role"_a, "start"_a, "end"_a, "start_s"_a = 0.0, "end_s"_a = 0.0)
      .def("labels_json", [](PySimulation& s) { return sim::labels_json(s.get().scene()); })
      .def("over", [](PySimulation& s) { return s.get().over(); })
      .def("decides", [](PySimulation& s) { return s.get().decides(); })
      .def("t_s", [](PySimulation& s) { return s.get().t_s(); })
      .def("seed", [](PySimulation& s) { return s.get().scenario().seed; })
      .def("world_seed", [](PySimulation& s) { return s.get().scenario().world_seed; })
      .def("control_rate_hz", [](PySimulation& s) { return s.get().scenario().control_rate_hz; })
      .def(
          "channel",
          [](PySimulation& s, const std::string& role) {
            s.get().camera(role);  // refuses a role that the rig lacks
            return s.get().scenario().rig.find(role)->channel;
          },
          "role"_a)
      .def("direct_hover",
           [](PySimulation& s) {
             const sim::DirectHover hover = sim::direct_hover(s.get().scenario().vehicle);
             return py::make_tuple(hover.thrust, Eigen::VectorXd(hover.speeds_radps), hover.highest_radps);
           })
      .def("limits",
           [](PySimulation& s) {
             const auto& limits = s.get().scenario().avionics.autopilot;
             return py::make_tuple(limits.speed_limit_mps, limits.acceleration_limit_mps2);
           })
      .def("scenario_yaml", [](PySimulation& s) { return sim::to_yaml(s.get().scenario()); });
}

}  // namespace hedgehop::python
