#include "dynamics/identification/flight_identification.h"

#include <numbers>
#include <variant>

#include "dynamics/control/hover_model.h"

namespace hedgehop::dynamics::identification {

Controls default_sizes(const VehicleConfig& vehicle) {
  constexpr double kBladeRad = 0.2 * std::numbers::pi / 180.0, kShare = 0.02;
  const auto* const multi = std::get_if<multicopter::MulticopterConfig>(&vehicle);
  return multi ? Controls(kShare * multicopter::authority(make_model(*multi)))
               : Controls(Controls::Constant(kBladeRad));
}

std::optional<Identification> identify(const VehicleConfig& vehicle, const SweepPlan& plan) {
  const std::optional<NamedLinearSystem> linear = linear_system(vehicle, plan.v_air_W);
  if (!linear) return std::nullopt;
  constexpr size_t kFrequencies = 40;
  constexpr int kStepsPerSample = 5;
  constexpr double kTailS = 10.0, kBeyond = 1.15;  // chosen: the vehicle settles after the sweep, which ends above --to
  constexpr double kRepeats[] = {1.0,
                                 -0.7};  // sizes of the sweeps of a control, whose difference shows in the coherence
  Controls sizes = default_sizes(vehicle);
  if (plan.size) sizes[plan.input] = *plan.size;

  TestFlight test{.v_air_W = plan.v_air_W,
                  .duration_s = plan.sweep.duration_s + kTailS,
                  .gain = holding_gain(*linear, control::make_hover_model(vehicle).acceptable),
                  .steps_per_sample = kStepsPerSample};
  Identification out{*linear, {}, {}, {}};
  FrequencySweep sweep = plan.sweep;
  sweep.to_radps *= kBeyond;
  for (Eigen::Index axis = 0; axis < kControlAxes; ++axis) {
    for (const double repeat : kRepeats) {
      sweep.size = repeat * sizes[axis];
      test.input = [sweep, axis](double t_s) { return Controls(sweep_input(sweep, t_s) * Controls::Unit(axis)); };
      std::optional<Record> record = fly_test(vehicle, test);
      if (!record) return std::nullopt;
      out.records.push_back(*std::move(record));
    }
  }
  const std::vector<double> frequencies = log_spaced(plan.sweep.from_radps, plan.sweep.to_radps, kFrequencies);
  out.measured = identified_response(out.records, frequencies);
  out.model = linear_response(linear->system, frequencies);
  return out;
}

}  // namespace hedgehop::dynamics::identification
