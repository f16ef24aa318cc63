#include "avoidance/flow_balance/confirmed_zig_zag.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hedgehop::avoidance::flow_balance {
namespace {

/// Images that must agree. A wrong flow vector seldom occurs in two successive images.
constexpr int kConfirmations = 2;
/// Angles of the path that a reversal compares. Chosen: one for every few degrees.
constexpr int kAngles = 9;
/// Loss of clearance that is not worth a turn back, m. Chosen: less than the error of a range from flow.
constexpr double kEqualM = 0.05;

double max_clearance_m(const auto& choices) {
  double max_m = -std::numeric_limits<double>::infinity();
  for (const auto& choice : choices) max_m = std::max(max_m, choice.path.clearance_m);
  return max_m;
}

/// Returns the first choice with the maximum of unvisited floor among those that keep a clearance.
auto most_unvisited(const auto& choices, double clearance_m) {
  auto best = choices.end();
  for (auto choice = choices.begin(); choice != choices.end(); ++choice) {
    if (choice->path.clearance_m < clearance_m) continue;
    if (best == choices.end() || choice->path.unvisited > best->path.unvisited) best = choice;
  }
  return *best;
}

}  // namespace

Eigen::Vector2d ConfirmedZigZag::velocity_H(const Course& course) const {
  return Eigen::Rotation2Dd(course.stray_rad) * course.signs_H.cwiseProduct(diagonal_.speed_mps);
}

void ConfirmedZigZag::add_choices(const Eigen::Vector2d& signs_H, const Foresee& foresee,
                                  std::vector<Choice>& choices) const {
  for (const double angle_rad : angles_rad_) {
    const Course course{signs_H, angle_rad};
    choices.push_back({course, foresee ? foresee(velocity_H(course)) : Path{}});
  }
}

/// Returns the best course that reverses a component and, if this keeps more clearance, the other one.
ConfirmedZigZag::Course ConfirmedZigZag::best_course(int reversed, const Foresee& foresee) const {
  Eigen::Vector2d signs_H = course_.signs_H;
  signs_H[reversed] *= -1.0;
  std::vector<Choice> one, both;
  add_choices(signs_H, foresee, one);
  add_choices(-course_.signs_H, foresee, both);
  const double enough_m = std::max(max_clearance_m(one), max_clearance_m(both)) - kEqualM;
  return most_unvisited(max_clearance_m(one) >= enough_m ? one : both, enough_m).course;
}

/// Changes to another course if there is no unvisited floor ahead but on the other one. @return whether it did.
bool ConfirmedZigZag::seek_unvisited(const Foresee& foresee) {
  constexpr int kUpdates = 25;         // between two examinations: the vehicle has reached its velocity
  constexpr double kWorthATurn = 3.0;  // squares
  if (!foresee || ++updates_ahead_ < kUpdates) return false;
  updates_ahead_ = 0;
  const Path ahead = foresee(velocity_H());
  if (ahead.unvisited > 0.0) return false;
  std::vector<Choice> choices;
  for (const double x : {1.0, -1.0}) {
    for (const double y : {1.0, -1.0}) add_choices({x, y}, foresee, choices);
  }
  const Choice best = most_unvisited(choices, max_clearance_m(choices) - kEqualM);
  if (best.path.unvisited < kWorthATurn) return false;
  course_ = best.course;
  return true;
}

void ConfirmedZigZag::draw_angles() {
  angles_rad_.clear();
  for (int i = 0; i < kAngles; ++i) angles_rad_.push_back(max_stray_rad_ * uniform(random_, -1.0, 1.0));
}

bool ConfirmedZigZag::reverses_both(std::span<const SideRange> sides, const Foresee& foresee) const {
  std::array<bool, 2> near{};
  const SideRange* nearest = nullptr;
  for (const SideRange& side : sides) {
    if (!is_too_near(side, diagonal_.range_threshold_m) || !leads_towards(course_.signs_H, side)) continue;
    near[static_cast<size_t>(component_along(side.axis_H))] = true;
    if (!nearest || side.inverse_range_per_m > nearest->inverse_range_per_m) nearest = &side;
  }
  if (!nearest || (near[0] && near[1])) return near[0] && near[1];
  const Course best = best_course(component_along(nearest->axis_H), foresee);
  return best.signs_H == -course_.signs_H;
}

bool ConfirmedZigZag::update(std::span<const SideRange> sides, const Foresee& foresee) {
  confirmed_.resize(sides.size(), 0);
  const SideRange* nearest = nullptr;
  for (size_t i = 0; i < sides.size(); ++i) {
    const SideRange& side = sides[i];
    if (!side.fresh) continue;
    confirmed_[i] = is_too_near(side, diagonal_.range_threshold_m) ? confirmed_[i] + 1 : 0;
    if (confirmed_[i] < kConfirmations || !leads_towards(course_.signs_H, side)) continue;
    if (!nearest || side.inverse_range_per_m > nearest->inverse_range_per_m) nearest = &side;
  }
  if (!nearest && !seek_unvisited(foresee)) return false;
  if (nearest) course_ = best_course(component_along(nearest->axis_H), foresee);
  draw_angles();
  std::fill(confirmed_.begin(), confirmed_.end(), 0);
  updates_ahead_ = 0;
  ++reversals_;
  return true;
}

}  // namespace hedgehop::avoidance::flow_balance
