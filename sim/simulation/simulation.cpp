#include "sim/simulation/simulation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "sim/collision/proximity.h"
#include "sim/flight/words.h"
#include "sim/loop/episode.h"
#include "sim/scenario/validate.h"
#include "sim/simulation/libraries.h"
#include "sim/simulation/map_judge.h"
#include "sim/verdict/assessment.h"
#include "sim/verdict/floor_visited.h"

namespace hedgehop::sim {
namespace {

/// Adds the wall time of its lifetime to a sum, for reports only.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum_s) : sum_s_(sum_s), start_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() { sum_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sum_s_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace

class Simulation::Impl {
 public:
  Impl(Scenario scenario, FlightParts parts, ModuleMaker module, FlightWatcher* watcher, OutsideAutopilot* outside)
      : scenario_(std::move(scenario)), make_module_(std::move(module)), watcher_(watcher), outside_(outside) {
    if (scenario_.link && !outside_) {
      throw InputError(FieldError{"link",
                                  "an autopilot outside Hedgehop flies this scenario; valid: hedgehop run, batch "
                                  "and sweep, or --set link=null"});
    }
    if (!scenario_.link && outside_) throw std::invalid_argument("the scenario has no link");
    keep_opencv_to_one_thread();
    environment_.emplace(scenario_, std::move(parts.files));
    begin(std::move(parts));
  }

  void reset(uint64_t seed, std::optional<uint64_t> world_seed) {
    if (outside_) throw std::logic_error("a linked flight cannot start again");
    episode_.reset();
    const uint64_t world = scenario_.world();
    scenario_.seed = seed;
    scenario_.world_seed = world_seed;
    if (scenario_.world() != world || !environment_) {
      environment_.reset();
      environment_.emplace(scenario_);
    }
    begin(build_parts(scenario_));
  }

  bool tick(const CallerCommand* command) {
    const Stopwatch stopwatch(flying_s_);
    episode().tick(command);
    return !episode().over();
  }

  bool step(const CallerCommand* command) {
    const Stopwatch stopwatch(flying_s_);
    episode().tick(command);
    while (!episode().over() && !episode().decides()) episode().tick();
    return !episode().over();
  }

  Proximity proximity_from(const ChosenPose& pose) {
    require_flight();
    return environment_->collision.query(pose.X_WB, std::numeric_limits<double>::infinity(), pose.t_s);
  }

  void fly_to(double t_s) {
    const Stopwatch stopwatch(flying_s_);
    const double half_tick_s = 0.5 / static_cast<double>(scenario_.physics_rate_hz.value());
    while (!episode().over() && episode().t_s() + half_tick_s < t_s) episode().tick();
    if (episode().t_s() + half_tick_s >= t_s) return;
    const FlightResult ended = episode().flight().result;
    throw InputError(fmt::format("the flight ends at {:.3f} s ({}{}{}), before {:g} s", episode().t_s(),
                                 to_string(ended.outcome), ended.cause.empty() ? "" : ": ", ended.cause, t_s));
  }

  size_t camera(std::string_view role) {
    if (scenario_.rig.find(role)) return episode().cameras().index(role);
    std::vector<std::string> roles;
    for (const CameraConfig& camera : scenario_.rig.cameras) roles.push_back(camera.role);
    throw InputError(fmt::format("the rig has no camera '{}'; its cameras: {}", role, fmt::join(roles, ", ")));
  }

  /// Returns the flight with its verdict, as if it ended now.
  Flight judged() const {
    Flight flight = episode().flight();
    flight.result.wall_s = flying_s_;
    flight.result.realtime_factor = flight.result.flight_time_s / flying_s_;
    flight.result.libraries = used_libraries(environment_->renderer.info());
    judge_->conclude(flight);
    assess(scenario_, *flight.scene, environment_->hull, flight);
    return flight;
  }

  Episode& episode() {
    require_flight();
    return *episode_;
  }
  const Episode& episode() const {
    require_flight();
    return *episode_;
  }
  const Scenario& scenario() const { return scenario_; }
  const scenes::Scene& scene() const {
    require_flight();
    return *environment_->scene;
  }

 private:
  /// Throws std::logic_error if the last reset failed.
  void require_flight() const {
    if (!episode_) throw std::logic_error("there is no flight: the last reset failed; reset again");
  }

  void begin(FlightParts parts) {
    require_floor_cells(scenario_, *environment_->scene);
    if (make_module_) parts.module = make_module_();
    flying_s_ = 0.0;
    judge_.emplace();
    const Stopwatch stopwatch(flying_s_);
    episode_.emplace(scenario_, *environment_, std::move(parts), watcher_, &*judge_, outside_);
    if (!outside_ && episode_->proximity().collided) {
      const std::string cause = episode_->flight().result.cause;
      episode_.reset();
      throw InputError(FieldError{"start", fmt::format("the vehicle collides at the start: {}", cause)});
    }
  }

  Scenario scenario_;
  ModuleMaker make_module_;
  FlightWatcher* watcher_;
  OutsideAutopilot* outside_;
  std::optional<FlightEnvironment> environment_;  ///< empty after a reset that could not make its new scene
  std::optional<MapJudge> judge_;
  std::optional<Episode> episode_;  ///< refers to all of the above; empty after a reset that failed
  double flying_s_ = 0.0;           ///< wall time
};

Simulation::Simulation(LoadedScenario loaded, FlightWatcher* watcher, OutsideAutopilot* outside) {
  try {
    impl_ =
        std::make_unique<Impl>(std::move(loaded.scenario), std::move(loaded.parts), ModuleMaker{}, watcher, outside);
  } catch (const InputError& error) {
    throw at_positions(loaded.root.get(), error);
  }
}

Simulation::Simulation(Scenario scenario, ModuleMaker module, FlightWatcher* watcher, OutsideAutopilot* outside) {
  Validation found = validate(scenario, module ? ModuleOwner::caller : ModuleOwner::scenario);
  if (!found.errors.empty()) throw InputError(std::move(found.errors));
  FlightParts parts = *std::move(found.parts);
  impl_ = std::make_unique<Impl>(std::move(scenario), std::move(parts), std::move(module), watcher, outside);
}

Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

void Simulation::reset() { reset(scenario().seed); }
void Simulation::reset(uint64_t seed) { reset(seed, scenario().world_seed); }
void Simulation::reset(uint64_t seed, std::optional<uint64_t> world_seed) { impl_->reset(seed, world_seed); }

bool Simulation::step() { return impl_->step(nullptr); }
bool Simulation::step(const CallerCommand& command) { return impl_->step(&command); }
bool Simulation::tick() { return impl_->tick(nullptr); }
bool Simulation::tick(const CallerCommand& command) { return impl_->tick(&command); }
void Simulation::fly_to(double t_s) { impl_->fly_to(t_s); }

Flight Simulation::run() {
  while (!over()) impl_->step(nullptr);
  return result();
}

bool Simulation::over() const { return impl_->episode().over(); }
bool Simulation::decides() const { return impl_->episode().decides(); }
double Simulation::t_s() const { return impl_->episode().t_s(); }
const Scenario& Simulation::scenario() const { return impl_->scenario(); }
const scenes::Scene& Simulation::scene() const { return impl_->scene(); }

avoidance::Observation Simulation::seen() const { return impl_->episode().observation(); }

TrueMotion Simulation::truth() const {
  const Aircraft& aircraft = impl_->episode().aircraft();
  const dynamics::RigidBodyState& body = aircraft.body();
  return {body.p_WB, body.q_WB, body.q_WB * body.v_WB_B, body.w_WB_B, aircraft.wind_W()};
}

const Proximity& Simulation::proximity() const { return impl_->episode().proximity(); }

const avoidance::MountedCamera& Simulation::camera(std::string_view role) const {
  return impl_->episode().cameras().mounted(impl_->camera(role));
}

cv::Mat Simulation::image(std::string_view role, ImageChannel channel) {
  if (channel == ImageChannel::flow)
    throw std::invalid_argument("optic flow needs a second image; use flow_to_next_image()");
  const size_t camera = impl_->camera(role);
  const Cameras::Instant now = impl_->episode().instant();
  return impl_->episode().cameras().image(camera, channel, now, now);
}

namespace {

Cameras::Instant instant_of(const ChosenPose& pose) {
  if (!pose.X_WB.matrix().allFinite() || !(pose.t_s >= 0.0) || !std::isfinite(pose.t_s)) {
    throw std::invalid_argument("a chosen pose must be finite, at a time of at least 0");
  }
  return {std::llround(1e9 * pose.t_s), {.X_WB = pose.X_WB}};
}

}  // namespace

cv::Mat Simulation::image_from(std::string_view role, ImageChannel channel, const ChosenPose& pose) {
  if (channel == ImageChannel::flow) throw std::invalid_argument("optic flow needs two poses; use flow_between()");
  const Cameras::Instant at = instant_of(pose);
  return impl_->episode().cameras().image(impl_->camera(role), channel, at, at);
}

Proximity Simulation::proximity_from(const ChosenPose& pose) {
  instant_of(pose);  // refuses a pose that is not finite
  return impl_->proximity_from(pose);
}

cv::Mat Simulation::flow_between(std::string_view role, const ChosenPose& from, const ChosenPose& to) {
  return impl_->episode().cameras().image(impl_->camera(role), ImageChannel::flow, instant_of(from), instant_of(to));
}

cv::Mat Simulation::flow_to_next_image(std::string_view role) {
  const size_t camera = impl_->camera(role);
  Cameras& cameras = impl_->episode().cameras();
  const Cameras::Instant now = impl_->episode().instant();
  fly_to(t_s() + 1.0 / cameras.mounted(camera).rate_hz);
  return cameras.image(camera, ImageChannel::flow, now, impl_->episode().instant());
}

std::vector<CheckResult> Simulation::checks_so_far() const { return impl_->judged().result.checks; }

Flight Simulation::result() const {
  if (!over()) throw std::logic_error("the flight is not over");
  return impl_->judged();
}

namespace {

class Hovering : public avoidance::Module {
 public:
  explicit Hovering(avoidance::Needs needs) : needs_(std::move(needs)) {}

 private:
  avoidance::Needs do_needs() const override { return needs_; }
  void do_reset(const avoidance::Setup&) override {}
  avoidance::Decision do_update(const avoidance::Observation&) override {
    return {avoidance::HoverCommand{}, "hover", {}};
  }
  avoidance::Needs needs_;
};

}  // namespace

ModuleMaker hovering(const RigConfig& rig, const std::vector<std::string>& roles) {
  avoidance::Needs needs;
  for (const std::string& role : roles) {
    const CameraConfig* const camera = rig.find(role);
    if (!camera) throw InputError(fmt::format("the rig has no camera '{}'", role));
    needs.cameras.push_back({role, camera->channel});
  }
  return [needs] { return std::make_unique<Hovering>(needs); };
}

}  // namespace hedgehop::sim
