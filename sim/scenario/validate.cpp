#include "sim/scenario/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iterator>
#include <memory>
#include <utility>
#include <variant>

#include "avoidance/module.h"
#include "sim/config/names.h"
#include "sim/fields/bounds.h"
#include "sim/fields/shortened.h"
#include "sim/scenario/avoidance_config.h"
#include "sim/scenario/rates.h"

namespace hedgehop::sim {
namespace {

using Channel = CameraConfig::Channel;

class Validator {
 public:
  Validator(Scenario& scenario, ModuleOwner source) : scenario_(scenario), source_(source) {}

  /// Returns whether every field is within its bounds.
  bool bounds() {
    for (const fields::InvalidField& error : fields::invalid_fields(scenario_)) add(error.key(), error.message());
    return errors_.empty();
  }

  /// Mounts the rig; returns whether that succeeds and every field is still within its bounds.
  bool mounts() {
    pairs_ = scenario_.rig.stereo.size();
    build("rig", [&] { mount_rig(scenario_.rig, scenario_.avionics.imu.p_BI_m); });
    return errors_.empty() && bounds();
  }

  /// The name is also the name of the folder of results.
  void name() {
    if (std::string fault = name_fault(scenario_.name); !fault.empty()) add("name", std::move(fault));
  }

  void altitudes() {
    const bool has_plane = std::visit([](const auto& chosen) { return chosen.added.has_plane(); }, scenario_.scene);
    if (!has_plane) return;
    const auto require_above = [this](const std::string& path, double altitude_m) {
      if (altitude_m >= 0.0) return;
      add(path,
          fmt::format("{} m is below the ground plane of the scene; valid: >= 0 m, or a scene with 'ground: none'",
                      altitude_m));
    };
    require_above("start.altitude", scenario_.start.altitude_m);
    if (scenario_.goal) require_above("goal.altitude", scenario_.goal->altitude_m);
    for (size_t i = 0; i < scenario_.route.size(); ++i)
      require_above(fmt::format("route.{}.altitude", i), scenario_.route[i].altitude_m);
    if (const auto& band = scenario_.altitude_band) require_above("altitude_band.min", band->min_m);
    if (const std::optional<double> stand_m = stand_altitude_m(scenario_)) {
      require_above("link.stand_altitude", *stand_m);
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
    const std::vector<FieldError> errors = set_physics_rate(scenario_);
    sensor_rates_fit_ = std::ranges::none_of(errors, [](const auto& e) { return e.path.starts_with("avionics."); });
    add_all(errors);
  }

  void rig() {
    const std::vector<CameraConfig>& cameras = scenario_.rig.cameras;
    for (size_t i = 0; i < cameras.size(); ++i) {
      const std::string path = camera_path(i);
      build(path, [&] {
        cameras[i].model();
        cameras[i].X_BC();
      });
      imperfections(path + ".imperfections", cameras[i]);
      if (std::string fault = name_fault(cameras[i].role); !fault.empty()) add(path + ".role", std::move(fault));
      for (size_t j = 0; j < i; ++j) {
        if (cameras[j].role == cameras[i].role) {
          add(path + ".role", fmt::format("'{}' has the role '{}' already", camera_path(j), cameras[i].role));
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
    if (source_ == ModuleOwner::scenario) own_module();
    if (const std::optional<TakeoverConfig>& takeover = scenario_.takeover) {
      if (takeover->at_s >= scenario_.duration_s) {
        add("takeover.at",
            fmt::format("must be before the end of the flight ({} s), got {}", scenario_.duration_s, takeover->at_s));
      }
      build("takeover.avoidance", [&] { takeover->avoidance.make(); });
    }
  }

  void own_module() {
    const PythonConfig* const script = scenario_.avoidance.python();
    std::error_code error;
    if (script && !std::filesystem::exists(script->python, error)) {
      add("avoidance.python", fmt::format("there is no such file: '{}'", script->python.string()));
      return;
    }
    build("avoidance", [&] {
      module_ = scenario_.avoidance.make();
      if (!module_) return;
      if (std::string fault = signal_fault(module_->signals()); !fault.empty()) add("avoidance", std::move(fault));
      for (const avoidance::CameraNeed& need : module_->needs().cameras) {
        for (const std::string& fault : scenario_.rig.lacks(need.role, need.channel, need.pinhole))
          add("avoidance", fault);
      }
    });
  }

  /// Resets the module with its cameras, because the two cameras of a pair may not match.
  void module_with_cameras() {
    if (!module_ || !errors_.empty()) return;
    build("avoidance", [&] { module_->reset(module_setup(scenario_)); });
  }

  void failures() {
    add_all(failure_errors(scenario_.failures, scenario_.duration_s,
                           {scenario_.rig, scenario_.vehicle, scenario_.avionics, scenario_.velocimeter.enabled}));
  }

  void parts() {
    if (!scenario_.route.empty() && !scenario_.goal) add("route", "needs a 'goal' as its end");
    if (const std::optional<AltitudeBandConfig>& band = scenario_.altitude_band) {
      const double start_m = scenario_.start.altitude_m;
      if (!(band->min_m < band->max_m)) {
        add("altitude_band.max", fmt::format("must be greater than 'min' ({} m), got {}", band->min_m, band->max_m));
      } else if (start_m < band->min_m || start_m > band->max_m) {
        add("start.altitude",
            fmt::format("{} m is outside the altitude_band, {} to {} m", start_m, band->min_m, band->max_m));
      }
    }
    build("scene", [&] { files_ = read_scene_files(scenario_.scene, scenario_.world()); });
    build("vehicle", [&] { vehicle_.emplace(scenario_.vehicle); });
    build("wind", [&] { wind_.emplace(build_wind(scenario_)); });
    // If the vehicle is invalid, the avionics are checked with a valid one, so that each error is reported once.
    const dynamics::VehicleConfig carrier = vehicle_ ? scenario_.vehicle : dynamics::VehicleConfig{};
    if (sensor_rates_fit_) build("avionics", [&] { avionics_.emplace(build_avionics(scenario_, carrier)); });
  }

  void checks() { add_all(check_errors(scenario_)); }
  void link() { add_all(link_errors(scenario_)); }

  Validation take() {
    Validation found{std::move(errors_), std::nullopt};
    const bool has_module = module_ || source_ == ModuleOwner::caller || scenario_.avoidance.is_foreign();
    if (vehicle_ && wind_ && avionics_ && has_module) {
      found.parts.emplace(AircraftParts{*std::move(vehicle_), *std::move(wind_), *std::move(avionics_)},
                          std::move(module_));
      found.parts->files = std::move(files_);
    }
    return found;
  }

 private:
  /// Returns the path of a mounted camera; the cameras of stereo pairs are the last ones.
  std::string camera_path(size_t i) const {
    const size_t listed = scenario_.rig.cameras.size() - 2 * pairs_;
    return i < listed ? fmt::format("rig.cameras.{}", i) : fmt::format("rig.stereo.{}", (i - listed) / 2);
  }

  /// Refuses imperfections that have no effect on the camera's channel.
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

  /// Runs a builder; adds an error if the part cannot be built.
  template <class Build>
  void build(const std::string& path, Build&& build) {
    try {
      build();
    } catch (const std::invalid_argument& error) {
      errors_.push_back(field_error(path, error));
    } catch (const InputError& error) {  // several errors, such as those of a calibration file
      if (error.field_errors().empty()) throw;
      for (const FieldError& field : error.field_errors()) add(join_path(path, field.path), field.message);
    }
  }

  void add(std::string path, std::string message) { errors_.push_back({std::move(path), std::move(message)}); }

  void add_all(std::vector<FieldError> errors) { std::ranges::move(errors, std::back_inserter(errors_)); }

  Scenario& scenario_;
  ModuleOwner source_;
  std::vector<FieldError> errors_;
  std::optional<dynamics::Vehicle> vehicle_;
  std::optional<dynamics::air::Wind> wind_;
  std::optional<dynamics::Avionics> avionics_;
  std::unique_ptr<avoidance::Module> module_;
  scenes::SceneFiles files_;
  size_t pairs_ = 0;  ///< stereo pairs of the rig before mounting
  bool sensor_rates_fit_ = true;
};

}  // namespace

std::string signal_fault(std::span<const avoidance::Signal> signals) {
  constexpr std::string_view kOwnColumns[] = {
      "t_s", "status", "cmd_v_north_mps", "cmd_v_east_mps", "cmd_altitude_m", "cmd_heading_rad"};
  for (const avoidance::Signal& signal : signals) {
    if (const std::string fault = name_fault(signal.name); !fault.empty()) {
      return fmt::format("the module's signal '{}': {}", shortened(signal.name, 40), fault);
    }
    if (std::ranges::find(kOwnColumns, signal.name) != std::end(kOwnColumns)) {
      return fmt::format("the module's signal '{}' has the name of a column of decisions.csv; rename it", signal.name);
    }
    if (std::ranges::count(signals, signal.name, &avoidance::Signal::name) > 1) {
      return fmt::format("the module's signal '{}' occurs twice", signal.name);
    }
  }
  return "";
}

Validation validate(Scenario& scenario, ModuleOwner source) {
  Validator validator(scenario, source);
  if (!validator.bounds()) return validator.take();
  if (!validator.mounts()) return validator.take();
  validator.name();
  validator.altitudes();
  validator.start();
  validator.rates();
  validator.rig();
  validator.module();
  validator.parts();
  validator.failures();
  validator.checks();
  validator.link();
  validator.module_with_cameras();
  return validator.take();
}

}  // namespace hedgehop::sim
