#include "sim/scenario/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <memory>
#include <utility>
#include <variant>

#include "avoidance/module.h"
#include "sim/scenario/check_faults.h"
#include "sim/scenario/foreign_config.h"

namespace hedgehop::sim {
namespace {

using Channel = CameraConfig::Channel;

class Validator {
 public:
  Validator(const Scenario& scenario, const Node& root, Faults& faults)
      : scenario_(scenario), root_(root), faults_(faults) {}

  /// It names a folder of results, too.
  void name() {
    constexpr size_t kMostLetters = 200;
    const std::string& name = scenario_.name;
    const bool has_bad = std::ranges::any_of(name, [](unsigned char c) { return c < 0x20 || c == 0x7f || c == '/'; });
    if (has_bad || name.empty() || name.starts_with('.') || name.size() > kMostLetters) {
      add("name", fmt::format("must be 1 to {} letters without '/' and control characters, and not begin with '.'",
                              kMostLetters));
    }
  }

  void start() {
    const auto* room = std::get_if<scenes::worlds::RoomConfig>(&scenario_.scene);
    if (!room) return;
    const StartConfig& start = scenario_.start;
    if (std::abs(start.north_m) > 0.5 * room->length_m || std::abs(start.east_m) > 0.5 * room->width_m ||
        (room->ceiling && start.altitude_m > room->height_m)) {
      add("start", fmt::format("is outside the room, which is {} m long (north), {} m wide and {} m high",
                               room->length_m, room->width_m, room->height_m));
    }
  }

  void rates() {
    constexpr int64_t kNsPerS = 1'000'000'000;
    const int64_t physics = scenario_.physics_rate_hz;
    if (kNsPerS % physics != 0) {
      add("physics_rate",
          fmt::format("{} Hz does not divide 1e9, so a step is no whole number of nanoseconds", physics));
      return;
    }
    divides_physics("control_rate", static_cast<double>(scenario_.control_rate_hz));
    for (size_t i = 0; i < scenario_.rig.cameras.size(); ++i) {
      divides_physics(fmt::format("rig.cameras.{}.rate", i), scenario_.rig.cameras[i].rate_hz);
    }
    if (scenario_.film.enabled) divides_physics("film.rate", scenario_.film.rate_hz);
  }

  void rig() {
    const std::vector<CameraConfig>& cameras = scenario_.rig.cameras;
    for (size_t i = 0; i < cameras.size(); ++i) {
      build(fmt::format("rig.cameras.{}", i), [&] { cameras[i].model(); });
      imperfections(fmt::format("rig.cameras.{}.imperfections", i), cameras[i]);
      const std::string path = fmt::format("rig.cameras.{}.role", i);
      if (cameras[i].role.empty()) add(path, "must not be empty");
      for (size_t j = 0; j < i; ++j) {
        if (cameras[j].role == cameras[i].role) {
          add(path, fmt::format("camera {} has the role '{}' already", j, cameras[i].role));
          break;
        }
      }
    }
    const VelocimeterConfig& velocimeter = scenario_.velocimeter;
    if (velocimeter.enabled) {
      for (const std::string& fault : scenario_.rig.lacks(velocimeter.camera, Channel::grey, /*pinhole=*/true)) {
        add("velocimeter.camera", fault + ". Mount one, name another, or fly with 'velocimeter.enabled: false'");
      }
    }
  }

  void module() {
    const PythonConfig* const script = scenario_.avoidance.python();
    std::error_code error;
    if (script && !std::filesystem::exists(script->python, error)) {
      add("avoidance.python", fmt::format("there is no such file: '{}'", script->python.string()));
      return;
    }
    build("avoidance", [&] {
      module_ = scenario_.avoidance.make();
      if (!module_) return;
      for (const avoidance::CameraNeed& need : module_->needs().cameras) {
        for (const std::string& fault : scenario_.rig.lacks(need.role, need.channel, need.pinhole))
          add("avoidance", fault);
      }
    });
    if (const std::optional<TakeoverConfig>& takeover = scenario_.takeover) {
      if (takeover->at_s >= scenario_.duration_s) {
        add("takeover.at", fmt::format("is not before the flight's end ({} s)", scenario_.duration_s));
      }
      build("takeover.avoidance", [&] { takeover->avoidance.make(); });
    }
  }

  /// With the cameras that it would fly with: those of a pair may not go together.
  void module_with_cameras() {
    if (!module_ || !faults_.empty()) return;
    build("avoidance", [&] { module_->reset(module_setup(scenario_)); });
  }

  void failures() {
    for (const FailureFault& fault :
         faults_of(scenario_.failures, scenario_.duration_s, scenario_.rig, scenario_.vehicle)) {
      add(fmt::format("failures.{}.{}", fault.failure, fault.key), fault.message);
    }
  }

  void parts() {
    if (!scenario_.route.empty() && !scenario_.goal) add("route", "needs a 'goal' where it ends");
    if (const std::optional<AltitudeBandConfig>& band = scenario_.altitude_band) {
      const double start_m = scenario_.start.altitude_m;
      if (!(band->min_m < band->max_m)) {
        add("altitude_band.max", fmt::format("must be greater than 'min' ({} m), got {}", band->min_m, band->max_m));
      } else if (start_m < band->min_m || start_m > band->max_m) {
        add("start.altitude",
            fmt::format("{} m is outside the altitude_band, {} to {} m", start_m, band->min_m, band->max_m));
      }
    }
    build("scene", [&] {
      scenes::Scene alone;
      std::visit([&](const auto& chosen) { scenes::mesh::add_imports(chosen.added.imports, alone); }, scenario_.scene);
    });
    build("vehicle", [&] { vehicle_.emplace(scenario_.vehicle); });
    build("wind", [&] { wind_.emplace(build_wind(scenario_)); });
    // A fault of the vehicle is reported once: beside a bad one the avionics are checked with a good one.
    const dynamics::VehicleConfig carrier = vehicle_ ? scenario_.vehicle : dynamics::VehicleConfig{};
    build("avionics", [&] { avionics_.emplace(build_avionics(scenario_, carrier)); });
  }

  void checks() {
    for (const CheckFault& fault : check_faults(scenario_)) add(fault.path, fault.message);
  }

  /// The parts; none when one could not be built.
  std::optional<FlightParts> take() {
    const bool has_module = module_ || scenario_.avoidance.is_foreign();
    if (!vehicle_ || !wind_ || !avionics_ || !has_module) return {};
    return FlightParts{{*std::move(vehicle_), *std::move(wind_), *std::move(avionics_)}, std::move(module_)};
  }

 private:
  /// None may be silently without effect.
  void imperfections(const std::string& path, const CameraConfig& camera) {
    const ImperfectionsConfig c = camera.imperfections.value_or(ImperfectionsConfig{});
    const auto refuse = [&](std::string_view key, bool is_on) {
      if (is_on)
        add(fmt::format("{}.{}", path, key),
            "is not for depth images; valid: disparity_noise, readout, drop, "
            "freeze, black");
    };
    if (camera.channel == Channel::depth) {
      refuse("vignetting", c.vignetting != 0.0);
      refuse("exposure", c.exposure_stops != 0.0);
      refuse("auto_exposure", c.auto_exposure_s != 0.0);
      refuse("full_well", c.full_well != 0.0);
      refuse("read_noise", c.read_noise != 0.0);
      refuse("fixed_pattern", c.fixed_pattern != 0.0);
      refuse("shutter", c.shutter_s != 0.0);
      if (c.disparity_noise_px != 0.0 && !camera.is_undistorted_pinhole()) {
        add(path + ".disparity_noise", "needs an undistorted pinhole");
      }
    } else if (c.disparity_noise_px != 0.0) {
      add(path + ".disparity_noise", "is for channel: depth alone");
    }
  }

  void divides_physics(const std::string& path, double rate_hz) {
    const double steps = static_cast<double>(scenario_.physics_rate_hz) / rate_hz;
    constexpr double kRoundOff = 1e-9;
    if (steps >= 1.0 && std::abs(steps - std::round(steps)) <= kRoundOff * steps) return;
    add(path, fmt::format("{} Hz does not divide the physics rate of {} Hz", rate_hz, scenario_.physics_rate_hz));
  }

  /// Runs a builder; a part that cannot be built is a fault.
  template <class Build>
  void build(const std::string& path, Build&& build) {
    try {
      build();
    } catch (const std::invalid_argument& error) {
      add(path + named_key(error.what()), error.what());
    }
  }

  /// ".key" when a message begins with "key: ", as those of the generators do.
  static std::string named_key(std::string_view message) {
    const size_t end = message.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_.");
    if (end == 0 || end == std::string_view::npos || message[end] != ':') return "";
    return fmt::format(".{}", message.substr(0, end));
  }

  void add(const std::string& path, std::string_view message) {
    faults_.add(place_of(root_, path), fmt::format("'{}': {}", path, message));
  }

  const Scenario& scenario_;
  const Node& root_;
  Faults& faults_;
  std::optional<dynamics::Vehicle> vehicle_;
  std::optional<dynamics::air::Wind> wind_;
  std::optional<dynamics::Avionics> avionics_;
  std::unique_ptr<avoidance::Module> module_;
};

}  // namespace

std::optional<FlightParts> validate(const Scenario& scenario, const Node& root, Faults& faults) {
  Validator validator(scenario, root, faults);
  validator.name();
  validator.start();
  validator.rates();
  validator.rig();
  validator.module();
  validator.parts();
  validator.failures();
  validator.checks();
  validator.module_with_cameras();
  return validator.take();
}

}  // namespace hedgehop::sim
