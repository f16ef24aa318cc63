#include "sim/flightlog/log_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "sim/config/input_error.h"
#include "sim/flightlog/log_comparison.h"
#include "sim/flightlog/recorded_flight.h"
#include "sim/flightlog/replay.h"
#include "sim/flightlog/state_errors.h"

namespace hedgehop::sim {
namespace {

/// The fitted part of the logs, and the residuals of a model there.
class LogResiduals {
 public:
  LogResiduals(const FittedModel& model, std::span<const std::filesystem::path> logs,
               std::span<const FitParameter> parameters, const FitPlan& plan)
      : base_(model), parameters_(parameters), plan_(plan) {
    for (const std::filesystem::path& log : logs) files_.push_back(log);
    columns_fitted_ =
        std::ranges::any_of(parameters, [](const FitParameter& p) { return p.name.starts_with("columns."); });
    flights_ = read(model);
    if (plan.horizon_s > 0.0) {
      choose_windows();
    } else if (std::ranges::any_of(flights_, [](const auto& flight) { return flight.specific_force_B.empty(); })) {
      throw InputError("--horizon 0: the logs need the columns fx_mps2, fy_mps2, fz_mps2");
    }
  }

  FittedModel at(const Eigen::VectorXd& z) const {
    FittedModel model = base_;
    for (size_t k = 0; k < parameters_.size(); ++k) {
      const FitParameter& p = parameters_[k];
      set_parameter(model, p, p.low + z[static_cast<Eigen::Index>(k)] * (p.high - p.low));
    }
    return model;
  }

  std::optional<Eigen::VectorXd> operator()(const Eigen::VectorXd& z) const {
    const FittedModel model = at(z);
    try {
      Replay replay(model.vehicle);
      const std::vector<RecordedFlight> reread = columns_fitted_ ? read(model) : std::vector<RecordedFlight>{};
      const std::vector<RecordedFlight>& flights = columns_fitted_ ? reread : flights_;
      Eigen::VectorXd r = plan_.horizon_s > 0.0 ? state_residuals(replay, flights) : force_residuals(replay, flights);
      if (!r.allFinite()) return std::nullopt;
      return r;
    } catch (const std::invalid_argument&) {
      return std::nullopt;  // the vehicle cannot fly
    }
  }

 private:
  struct Window {
    size_t flight, start, half, count;  ///< count samples, `half` to the middle
  };

  std::vector<RecordedFlight> read(const FittedModel& model) const {
    std::vector<RecordedFlight> flights;
    for (const std::filesystem::path& file : files_) {
      flights.push_back(read_recorded_flight(file, model.columns, model.vehicle));
    }
    return flights;
  }

  void choose_windows() {
    MeanSquares held;
    for (size_t f = 0; f < flights_.size(); ++f) {
      const RecordedFlight& flight = flights_[f];
      require_samples_within(flight, plan_.horizon_s);
      const LogPart part = part_of(flight, LogShare::first, plan_.split);
      const auto count = static_cast<size_t>(std::max(2.0, std::round(plan_.horizon_s / flight.period_s)));
      const auto every = static_cast<size_t>(std::max(1.0, std::round(plan_.every_s / flight.period_s)));
      for (size_t i = part.begin; i + count < part.end; i += every) {
        const auto first = flight.gap_after.begin() + static_cast<std::ptrdiff_t>(i);
        if (std::find(first, first + static_cast<std::ptrdiff_t>(count), true) !=
            first + static_cast<std::ptrdiff_t>(count)) {
          continue;
        }
        windows_.push_back({f, i, count / 2, count});
        held.add(state_error(flight.states[i], flight.states[i + count]));
      }
    }
    if (windows_.empty()) {
      throw InputError(fmt::format("no window of {} s fits into the first part of the logs", plan_.horizon_s));
    }
    const Eigen::Vector4d norms = group_norms(held.rmse());
    constexpr double kMinScale = 1e-3;  // m, m/s, rad, rad/s: for groups that do not move
    for (Eigen::Index k = 0; k < weight_.size(); ++k) weight_[k] = 1.0 / std::max(norms[k / kPerGroup], kMinScale);
    if (!std::ranges::all_of(flights_, &RecordedFlight::has_position)) weight_.head<kPerGroup>().setZero();
  }

  Eigen::VectorXd state_residuals(Replay& replay, const std::vector<RecordedFlight>& flights) const {
    constexpr Eigen::Index kPerWindow = 24;
    Eigen::VectorXd r(kPerWindow * static_cast<Eigen::Index>(windows_.size()));
    Eigen::Index at = 0;
    for (const Window& w : windows_) {
      const RecordedFlight& flight = flights[w.flight];
      const auto states = replay.predict(flight, w.start, w.count);
      for (const size_t k : {w.half, w.count}) {
        r.segment<12>(at) = weight_.cwiseProduct(state_error(states[k - 1], flight.states[w.start + k]));
        at += 12;
      }
    }
    return r;
  }

  Eigen::VectorXd force_residuals(Replay& replay, const std::vector<RecordedFlight>& flights) const {
    std::vector<double> values;
    for (const RecordedFlight& flight : flights) {
      const LogPart part = part_of(flight, LogShare::first, plan_.split);
      const auto forces = replay.specific_forces_B(flight, part.begin, part.end);
      for (size_t i = 0; i < forces.size(); ++i) {
        const Eigen::Vector3d error = forces[i] - flight.specific_force_B[part.begin + i];
        values.insert(values.end(), error.begin(), error.end());
      }
    }
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  }

  FittedModel base_;
  std::span<const FitParameter> parameters_;
  FitPlan plan_;
  std::vector<std::filesystem::path> files_;
  bool columns_fitted_ = false;
  std::vector<RecordedFlight> flights_;
  std::vector<Window> windows_;
  StateError weight_ = StateError::Ones();
};

}  // namespace

LogFit fit_logs(const FittedModel& model, std::span<const std::filesystem::path> logs,
                std::span<const FitParameter> parameters, const FitPlan& plan) {
  const LogResiduals residuals(model, logs, parameters, plan);
  Eigen::VectorXd z(static_cast<Eigen::Index>(parameters.size()));
  LogFit out;
  for (size_t k = 0; k < parameters.size(); ++k) {
    const FitParameter& p = parameters[k];
    out.start.push_back(parameter_value(model, p));
    z[static_cast<Eigen::Index>(k)] = std::clamp((out.start.back() - p.low) / (p.high - p.low), 0.0, 1.0);
  }
  try {
    out.fit = fit_in_box(std::cref(residuals), z, plan.max_steps);
  } catch (const std::invalid_argument&) {
    throw InputError("the vehicle cannot fly with the start values of the fit, moved into their bounds");
  }
  out.model = residuals.at(out.fit.z);
  out.data = determination(out.fit.jacobian, out.fit.cost);
  out.residuals = static_cast<size_t>(out.fit.jacobian.rows());
  for (size_t k = 0; k < parameters.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    out.values.push_back(parameter_value(out.model, parameters[k]));
    out.standard_error.push_back(out.data.standard_error[i] * (parameters[k].high - parameters[k].low));
  }
  return out;
}

}  // namespace hedgehop::sim
