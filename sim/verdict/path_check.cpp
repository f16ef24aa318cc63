#include "sim/verdict/path_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/flight/build.h"
#include "sim/scenario/reference_path.h"
#include "sim/verdict/path_distance.h"

namespace hedgehop::sim {
namespace {

/// Returns the place and time at which the flight left the path; "" if it was always within the limit at equal times.
std::string where_left(const std::vector<TimedPoint>& flown, const std::vector<TimedPoint>& reference, double limit_m) {
  const TimedPoint* const left = first_beyond(flown, reference, limit_m);
  if (!left) return "";
  return fmt::format("left the reference at {:.2f} s, north {:.1f} m, east {:.1f} m, altitude {:.1f} m", left->t_s,
                     left->p_WB.x(), left->p_WB.y(), -left->p_WB.z());
}

/// Returns the time of the maximum distance at equal times.
double time_of_maximum_s(const std::vector<TimedPoint>& flown, const std::vector<TimedPoint>& reference) {
  return std::ranges::max_element(flown, {},
                                  [&](const TimedPoint& p) { return (p.p_WB - position_at(reference, p.t_s)).norm(); })
      ->t_s;
}

/// Returns the points of a table by hand with further ones on its segments, about every step; those of `bless`
/// unchanged.
std::vector<TimedPoint> filled(const ReferencePath& reference) {
  constexpr double kMaxPoints = 10e3;
  if (!reference.version.empty()) return reference.points;
  const double span_s = reference.points.back().t_s - reference.points.front().t_s;
  const double step_s = std::max(reference.step_s, span_s / kMaxPoints);
  std::vector<TimedPoint> points;
  for (const TimedPoint& end : reference.points) {
    const TimedPoint from = points.empty() ? end : points.back();
    const int parts = std::max(1, static_cast<int>(std::lround((end.t_s - from.t_s) / step_s)));
    for (int k = 1; k < parts; ++k) {
      const double t_s = from.t_s + (end.t_s - from.t_s) * k / parts;
      points.push_back({t_s, position_at(reference.points, t_s)});
    }
    points.push_back(end);
  }
  return points;
}

/// Returns the distance, which includes the distance of the ends: the mean alone would not show that the end of the
/// path is missing.
double shape_distance_m(const PathToleranceCheck& check, const std::vector<TimedPoint>& flown,
                        const ReferencePath& reference) {
  const std::vector<TimedPoint> coarse = thinned(flown, reference.step_s), points = filled(reference);
  const double distance_m = check.measure == PathToleranceCheck::Measure::frechet
                                ? discrete_frechet_m(coarse, points)
                                : mean_warped_distance_m(coarse, points);
  const double ends_apart_m = (flown.back().p_WB - reference.points.back().p_WB).norm();
  return ends_apart_m > check.at_most_m ? std::max(distance_m, ends_apart_m) : distance_m;
}

CheckResult compare(const PathToleranceCheck& check, const ReferencePath& reference, const Flight& flight) {
  std::vector<TimedPoint> flown;
  for (const TrajectoryRow& row : flight.trajectory) flown.push_back({row.t_s, row.p_WB_true});
  const std::string name{PathToleranceCheck::kName};
  if (flown.empty()) return {name, false, std::numeric_limits<double>::quiet_NaN(), check.at_most_m, "m"};
  const std::string left = where_left(flown, reference.points, check.at_most_m);
  if (check.measure != PathToleranceCheck::Measure::band) {
    const double value_m = shape_distance_m(check, flown, reference);
    const bool passed = value_m <= check.at_most_m;
    return {name, passed, value_m, check.at_most_m, "m", "<=", {}, passed ? "" : left};
  }
  // A flight may reach its goal early. If it ends elsewhere, the rest of the path is missing.
  constexpr double kRoundedS = 1e-3;  // rounding of the reference's times
  const double end_s = flown.back().t_s, reference_end_s = reference.points.back().t_s;
  if (reference_end_s - end_s > kRoundedS && flight.result.outcome != Outcome::reached) {
    return {name, false, end_s, reference_end_s,
            "s",  ">=",  {},    "end of the flight" + (left.empty() ? "" : "; " + left)};
  }
  const double value_m = max_deviation_m(flown, reference.points);
  const bool passed = value_m <= check.at_most_m;
  return {name,
          passed,
          value_m,
          check.at_most_m,
          "m",
          "<=",
          time_of_maximum_s(flown, reference.points),
          passed ? "" : left};
}

}  // namespace

CheckResult evaluate_path(const PathToleranceCheck& check, const Flight& flight, uint64_t seed) {
  const ReferencePath reference = read_reference_path(check.reference);
  CheckResult result = compare(check, reference, flight);
  const bool other = reference.seed != seed || reference.version != version();
  if (!result.passed && other && !reference.version.empty()) {  // a table by hand has no version
    const std::string own = reference.version == version() ? "" : fmt::format("; this is {}", version());
    result.cause += fmt::format("{}(reference: seed {}, version {}{})", result.cause.empty() ? "" : " ", reference.seed,
                                reference.version, own);
  }
  return result;
}

}  // namespace hedgehop::sim
