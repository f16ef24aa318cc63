#include "sim/flightlog/log_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <variant>

#include "sim/config/input_error.h"
#include "sim/flightlog/replay.h"

namespace hedgehop::sim {
namespace {

/// Returns the number of samples after `start` that a horizon spans; nullopt if it leaves the part or crosses a pause.
std::optional<size_t> span_of(const LogPart& part, size_t start, double horizon_s) {
  const RecordedFlight& flight = *part.flight;
  const double half_period_s = 0.5 * flight.period_s;
  for (size_t i = start; i + 1 < part.end && !flight.gap_after[i]; ++i) {
    if (flight.t_s[i + 1] - flight.t_s[start] >= horizon_s - half_period_s) return i + 1 - start;
  }
  return std::nullopt;
}

struct Sums {
  MeanSquares model, held, constant_velocity, linear;
};

/// Adds the errors of all horizons that fit after `start`. @return whether there was one.
bool add_window(const LogPart& part, size_t start, const ComparisonPlan& plan, Replay& replay,
                const LinearPredictor& linear, std::vector<Sums>& sums) {
  std::vector<size_t> spans;
  for (const double horizon_s : plan.horizons_s) {
    const std::optional<size_t> span = span_of(part, start, horizon_s);
    if (!span) break;
    spans.push_back(*span);
  }
  if (spans.empty()) return false;
  const RecordedFlight& flight = *part.flight;
  const auto predicted = replay.predict(flight, start, spans.back());
  const auto by_linear = linear.predict(flight, start, spans.back());
  for (size_t h = 0; h < spans.size(); ++h) {
    const size_t last = start + spans[h];
    const dynamics::RigidBodyState& measured = flight.states[last];
    sums[h].model.add(state_error(predicted[spans[h] - 1], measured));
    sums[h].held.add(state_error(flight.states[start], measured));
    sums[h].constant_velocity.add(
        state_error(at_constant_velocity(flight.states[start], flight.t_s[last] - flight.t_s[start]), measured));
    sums[h].linear.add(state_error(by_linear[spans[h] - 1], measured));
  }
  return true;
}

double mass_kg(const dynamics::VehicleConfig& vehicle) {
  return std::visit([](const auto& config) { return config.mass.mass_kg; }, vehicle);
}

void add_force(const LogPart& part, Replay& replay, double mass_kg, double& sum_n2, size_t& count) {
  const auto forces = replay.specific_forces_B(*part.flight, part.begin, part.end);
  for (size_t i = 0; i < forces.size(); ++i) {
    sum_n2 += (mass_kg * (forces[i] - part.flight->specific_force_B[part.begin + i])).squaredNorm();
  }
  count += forces.size();
}

std::string_view name_of(LogColumnsConfig::Inputs kind) {
  return LogColumnsConfig::kInputNames.at(static_cast<size_t>(kind));
}

/// Refuses logs that no linear model can be fitted to together.
void require_equal_inputs(std::span<const RecordedFlight> flights) {
  constexpr double kMaxRatio = 1.1;  // of the periods; clocks differ by less
  const RecordedFlight& first = flights.front();
  for (const RecordedFlight& other : flights.subspan(1)) {
    if (other.kind != first.kind || other.inputs.cols() != first.inputs.cols()) {
      throw InputError(fmt::format("{} has {} columns of {}, {} has {} of {}; logs of one call need the same inputs",
                                   first.file, first.inputs.cols(), name_of(first.kind), other.file,
                                   other.inputs.cols(), name_of(other.kind)));
    }
    if (std::max(first.period_s, other.period_s) > kMaxRatio * std::min(first.period_s, other.period_s)) {
      throw InputError(
          fmt::format("{} has a sample every {:.4g} s, {} every {:.4g} s; logs of one call need the same rate",
                      first.file, first.period_s, other.file, other.period_s));
    }
  }
}

}  // namespace

LogPart part_of(const RecordedFlight& flight, LogShare share, double split) {
  const double at_s = flight.t_s.front() + split * (flight.t_s.back() - flight.t_s.front());
  const auto middle =
      static_cast<size_t>(std::lower_bound(flight.t_s.begin(), flight.t_s.end(), at_s) - flight.t_s.begin());
  switch (share) {
    case LogShare::first:
      return {&flight, 0, middle};
    case LogShare::second:
      return {&flight, middle, flight.size()};
    case LogShare::all:
      break;
  }
  return {&flight, 0, flight.size()};
}

void require_samples_within(const RecordedFlight& flight, double horizon_s) {
  constexpr double kMaxPeriods = 1.5;  // a window has a whole number of periods
  if (flight.period_s <= kMaxPeriods * horizon_s) return;
  throw InputError(
      fmt::format("{}: a sample every {:.4g} s, but the horizon is {} s; choose a longer --horizon, or, if t_s is in "
                  "ms, map it with scale: 0.001 (--columns)",
                  flight.file, flight.period_s, horizon_s));
}

LogComparison compare_logs(const dynamics::VehicleConfig& vehicle, std::span<const RecordedFlight> flights,
                           const ComparisonPlan& plan) {
  constexpr std::array<LogShare, 2> kHalves = {LogShare::first, LogShare::second};
  require_equal_inputs(flights);
  for (const RecordedFlight& flight : flights) require_samples_within(flight, plan.horizons_s.front());
  Replay replay(vehicle);
  std::vector<Sums> sums(plan.horizons_s.size());
  LogComparison out;
  out.inputs = flights.front().kind;
  out.has_position = std::ranges::all_of(flights, &RecordedFlight::has_position);
  const bool forces =
      std::ranges::all_of(flights, [](const RecordedFlight& flight) { return !flight.specific_force_B.empty(); });
  double sum_n2 = 0.0;
  for (const LogShare half : kHalves) {
    if (plan.share != LogShare::all && plan.share != half) continue;
    const LogShare other = half == LogShare::first ? LogShare::second : LogShare::first;
    std::vector<LogPart> others;
    for (const RecordedFlight& flight : flights) others.push_back(part_of(flight, other, plan.split));
    const LinearPredictor linear{others};
    for (const RecordedFlight& flight : flights) {
      const LogPart part = part_of(flight, half, plan.split);
      double next_s = -INFINITY;
      for (size_t i = part.begin; i < part.end; ++i) {
        if (flight.t_s[i] < next_s) continue;
        if (add_window(part, i, plan, replay, linear, sums))
          next_s = flight.t_s[i] + plan.every_s - 0.5 * flight.period_s;
      }
      if (forces) add_force(part, replay, mass_kg(vehicle), sum_n2, out.force_samples);
    }
  }
  if (sums.front().model.count() == 0) {
    throw InputError(fmt::format("no window of {} s fits into the logs without a pause", plan.horizons_s.front()));
  }
  for (size_t h = 0; h < sums.size(); ++h) {
    const Sums& s = sums[h];
    if (s.model.count() == 0) continue;
    out.rows.push_back({plan.horizons_s[h], s.model.count(), s.model.rmse(), s.held.rmse(), s.constant_velocity.rmse(),
                        s.linear.rmse()});
  }
  if (out.force_samples > 0) out.force_rmse_n = std::sqrt(sum_n2 / static_cast<double>(out.force_samples));
  return out;
}

}  // namespace hedgehop::sim
