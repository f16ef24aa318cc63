#include "sim/verdict/formula_check.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <optional>

#include "dynamics/rigid_body.h"
#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Returns NaN if either number is NaN, which std::min and std::max do not.
template <class Operation>
double of_known(double a, double b, const Operation& operation) {
  return std::isnan(a) || std::isnan(b) ? kUnknown : operation(a, b);
}

double evaluate(const Expression& e, const SampledSignals& signals, size_t sample) {
  const auto part = [&](size_t i) { return evaluate(e.of[i], signals, sample); };
  switch (e.kind) {
    case Expression::Kind::number:
      return e.number;
    case Expression::Kind::signal:
      return signals.numbers.at(e.signal)[sample];
    case Expression::Kind::add:
      return part(0) + part(1);
    case Expression::Kind::subtract:
      return part(0) - part(1);
    case Expression::Kind::multiply:
      return part(0) * part(1);
    case Expression::Kind::divide:
      return part(0) / part(1);
    case Expression::Kind::negate:
      return -part(0);
    case Expression::Kind::abs:
      return std::abs(part(0));
    case Expression::Kind::min:
      return of_known(part(0), part(1), [](double a, double b) { return std::min(a, b); });
    case Expression::Kind::max:
      return of_known(part(0), part(1), [](double a, double b) { return std::max(a, b); });
  }
  return 0.0;
}

/// An interval in samples, both ends included; without `last` it extends to the end.
struct SampleWindow {
  size_t first = 0;
  std::optional<size_t> last;
  bool empty() const { return last && *last < first; }
};

SampleWindow window(const TimeInterval& interval, double dt_s) {
  constexpr double kRoundOff = 1e-9;
  SampleWindow window{.first = static_cast<size_t>(std::ceil(interval.from_s / dt_s - kRoundOff)), .last = {}};
  if (interval.to_s) window.last = static_cast<size_t>(std::floor(*interval.to_s / dt_s + kRoundOff));
  return window;
}

/// Evaluates a formula bottom up, all samples of a subformula at once.
class Evaluator {
 public:
  explicit Evaluator(const SampledSignals& signals) : signals_(signals) {}
  size_t comparisons() const { return comparisons_; }

  /// @param unknown  robustness of a comparison with NaN: that which makes the whole formula fail.
  Robustness of(const Formula& formula, double unknown = -kInfinity) {
    const auto part = [&](size_t i) { return of(formula.of[i], unknown); };
    const auto negated_part = [&] { return negated(of(formula.of[0], -unknown)); };
    switch (formula.kind) {
      case Formula::Kind::at_least_zero:
      case Formula::Kind::has_status:
        return of_samples(formula, unknown);
      case Formula::Kind::negation:
        return negated_part();
      case Formula::Kind::conjunction:
        return min(part(0), part(1));
      case Formula::Kind::disjunction:
        return max(part(0), part(1));
      case Formula::Kind::implication:
        return max(negated_part(), part(1));
      case Formula::Kind::always:
        return window_min(part(0), window(formula.interval, signals_.dt_s));
      case Formula::Kind::eventually:
        return window_max(part(0), window(formula.interval, signals_.dt_s));
      case Formula::Kind::until:
        return until(part(0), part(1), window(formula.interval, signals_.dt_s));
    }
    return {};
  }

 private:
  Robustness filled(double value) const {
    return {std::vector<double>(signals_.samples, value), std::vector<size_t>(signals_.samples, 0), 0};
  }

  Robustness of_samples(const Formula& formula, double unknown) const {
    Robustness r = filled(0.0);
    for (size_t i = 0; i < signals_.samples; ++i) {
      if (formula.kind == Formula::Kind::has_status) {
        r.value[i] = signals_.status.at(i) == formula.status ? kInfinity : -kInfinity;
      } else {
        const double margin = evaluate(formula.margin, signals_, i);
        r.value[i] = std::isnan(margin) ? unknown : margin;
      }
      r.decisive[i] = i;
    }
    return r;
  }

  static Robustness negated(Robustness r) {
    for (double& value : r.value) value = -value;
    return r;
  }

  /// Of equal values, the one determined earlier is the smaller.
  bool is_less(double a, size_t a_at, double b, size_t b_at) {
    ++comparisons_;
    return a < b || (a == b && a_at < b_at);
  }

  Robustness min(Robustness a, const Robustness& b) {
    for (size_t i = 0; i < a.value.size(); ++i) {
      if (is_less(a.value[i], a.decisive[i], b.value[i], b.decisive[i])) continue;
      a.value[i] = b.value[i];
      a.decisive[i] = b.decisive[i];
    }
    return a;
  }
  Robustness max(Robustness a, Robustness b) { return negated(min(negated(std::move(a)), negated(std::move(b)))); }

  /// Returns the minimum over the window of each sample. Time runs backwards. From the front, the queue contains the
  /// newest sample, then each later sample that is smaller than all before it; the last is the minimum.
  Robustness window_min(const Robustness& r, SampleWindow window) {
    Robustness result = filled(kInfinity);
    const size_t samples = r.value.size();
    if (window.empty()) return result;
    std::deque<size_t> queue;
    for (size_t i = samples; i-- > 0;) {
      result.decisive[i] = samples - 1;
      if (window.first >= samples - i) continue;
      const size_t entering = i + window.first;
      while (!queue.empty() &&
             is_less(r.value[entering], r.decisive[entering], r.value[queue.front()], r.decisive[queue.front()])) {
        queue.pop_front();
      }
      queue.push_front(entering);
      while (window.last && queue.back() - i > *window.last) queue.pop_back();
      result.value[i] = r.value[queue.back()];
      result.decisive[i] = r.decisive[queue.back()];
    }
    return result;
  }
  Robustness window_max(Robustness r, SampleWindow window) {
    return negated(window_min(negated(std::move(r)), window));
  }

  /// f until[a,b] g = eventually[a,b] g, and always[0,a) f, and f until g a samples later.
  Robustness until(const Robustness& f, const Robustness& g, SampleWindow window) {
    const size_t samples = g.value.size();
    Robustness unbounded = g;  // max(g_i, min(f_i, of the next)), from the end
    for (size_t i = samples; i-- > 1;) {
      const size_t now = i - 1;
      const bool f_less = is_less(f.value[now], f.decisive[now], unbounded.value[i], unbounded.decisive[i]);
      const double value = f_less ? f.value[now] : unbounded.value[i];
      if (is_less(value, 0, g.value[now], 0) || value == g.value[now]) continue;
      unbounded.value[now] = value;
      unbounded.decisive[now] = f_less ? f.decisive[now] : unbounded.decisive[i];
    }
    Robustness later = filled(-kInfinity);
    for (size_t i = 0; i < samples && window.first < samples - i; ++i) {
      later.value[i] = unbounded.value[i + window.first];
      later.decisive[i] = unbounded.decisive[i + window.first];
    }
    Robustness result = min(window_max(g, window), later);
    if (window.first > 0) result = min(std::move(result), window_min(f, {.first = 0, .last = window.first - 1}));
    return result;
  }

  const SampledSignals& signals_;
  size_t comparisons_ = 0;
};

}  // namespace

Robustness robustness(const Formula& formula, const SampledSignals& signals) {
  Evaluator evaluator(signals);
  Robustness result = evaluator.of(formula);
  result.comparisons = evaluator.comparisons();
  return result;
}

namespace {

double degrees(double angle_rad) { return 180.0 / std::numbers::pi * angle_rad; }

double wrapped_deg(double angle_rad) { return degrees(dynamics::wrap_angle(angle_rad)); }

void add_motion(const TrajectoryRow& row, const Scenario& scenario, SampledSignals& signals) {
  const auto add = [&](const char* name, double value) { signals.numbers[name].push_back(value); };
  add("north", row.p_WB_true.x());
  add("east", row.p_WB_true.y());
  add("altitude", -row.p_WB_true.z());
  add("speed", row.v_WB_W_true.norm());
  add("climb", -row.v_WB_W_true.z());
  add("roll", degrees(row.rpy_true.x()));
  add("pitch", degrees(row.rpy_true.y()));
  add("heading", wrapped_deg(row.rpy_true.z()));
  add("tilt", degrees(dynamics::tilt_rad(row.rpy_true)));
  add("wind", row.wind_W.norm());
  const Eigen::Vector2d v_NE = row.v_WB_W_true.head<2>();
  add("tracking_error", row.v_WB_W_cmd ? (*row.v_WB_W_cmd - v_NE).norm() : kUnknown);
  add("estimation_error", (row.p_WB_est - row.p_WB_true).norm());
  add("goal_distance", scenario.goal ? (row.p_WB_true - scenario.goal->p_WG()).head<2>().norm() : kUnknown);
}

/// Returns the distances at the control ticks, including the closest approach between them.
std::vector<double> clearances(const Flight& flight, double TrajectoryRow::*distance_m, const ClosestApproach& closest,
                               double dt_s) {
  std::vector<double> values;
  for (const TrajectoryRow& row : flight.trajectory) values.push_back(std::min(row.*distance_m, kMaxClearanceM));
  if (values.empty() || !(closest.distance_m < kMaxClearanceM)) return values;
  constexpr double kRoundOff = 1e-9;
  const auto sample = static_cast<size_t>(std::max(0.0, std::floor(closest.t_s / dt_s + kRoundOff)));
  double& value = values[std::min(sample, values.size() - 1)];
  value = std::min(value, closest.distance_m);
  return values;
}

/// Returns the status at each row: that of the last decision.
std::vector<std::string> status_words(const Flight& flight) {
  std::vector<std::string> words;
  auto next = flight.decisions.begin();
  for (const TrajectoryRow& row : flight.trajectory) {
    while (next != flight.decisions.end() && next->t_s <= row.t_s) ++next;
    words.push_back(next == flight.decisions.begin() ? "" : std::prev(next)->status);
  }
  return words;
}

}  // namespace

SampledSignals flight_signals(const Scenario& scenario, const Flight& flight) {
  SampledSignals signals{.dt_s = 1.0 / static_cast<double>(scenario.control_rate_hz),
                         .samples = flight.trajectory.size(),
                         .numbers = {},
                         .status = status_words(flight)};
  for (const TrajectoryRow& row : flight.trajectory) add_motion(row, scenario, signals);
  const FlightResult& result = flight.result;
  const std::vector<double> obstacle =
      clearances(flight, &TrajectoryRow::obstacle_clearance_m, result.closest_obstacle, signals.dt_s);
  const std::vector<double> ground =
      clearances(flight, &TrajectoryRow::ground_clearance_m, result.closest_ground, signals.dt_s);
  std::vector<double>& nearest = signals.numbers["clearance"];
  for (size_t i = 0; i < obstacle.size(); ++i) nearest.push_back(std::min(obstacle[i], ground[i]));
  signals.numbers["obstacle_clearance"] = obstacle;
  signals.numbers["ground_clearance"] = ground;
  return signals;
}

CheckResult evaluate_formula(const FormulaCheck& check, const Scenario& scenario, const Flight& flight) {
  const SampledSignals signals = flight_signals(scenario, flight);
  CheckResult result{check.name, false, kUnknown, 0.0, "", ">="};
  if (signals.samples == 0) return result;
  const Formula formula = parse_formula(check.formula);
  const Robustness r = robustness(formula, signals);
  result.value = r.value[0];
  result.passed = result.value >= 0.0;
  const TrajectoryRow& decisive = flight.trajectory[r.decisive[0]];
  result.t_s = decisive.t_s;
  const bool may_be_unknown =
      result.value == -kInfinity && !decisive.v_WB_W_cmd && uses_signal(formula, "tracking_error");
  // The unknown values are the cause only if the formula could hold with others.
  if (may_be_unknown && Evaluator(signals).of(formula, kInfinity).value[0] >= 0.0)
    result.cause = "no velocity was commanded";
  return result;
}

}  // namespace hedgehop::sim
