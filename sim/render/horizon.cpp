#include "sim/render/horizon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hedgehop::sim {

namespace {

constexpr int kBins = 2048;  // of at most 0.22 deg
constexpr int kBinMask = kBins - 1;
constexpr double kNothing = -std::numeric_limits<double>::infinity();
// The rasteriser's 1/256 pixel and the float geometry are far below these.
constexpr double kInsetM = 0.02;        // a hiding box counts as this much smaller in plan
constexpr double kSlackRad = 1e-3;      // and this much lower
constexpr double kTooNearM = 1.0;       // the near plane may cut a nearer box open
constexpr double kBinChord = 0.999995;  // at most cos(half a bin): a bin's middle is nearer than the chord of its ends

/// Grows with the angle from north to east: 0 north, 1 east, 2 south, 3 west, 4 north again.
double square_angle(double north, double east) {
  const double p = north / (std::abs(north) + std::abs(east));
  return east >= 0.0 ? 1.0 - p : 3.0 + p;
}

struct Crossing {
  double in_m = 0.0, out_m = 0.0;
};

/// Where a ray from the origin enters and leaves a rectangle that it crosses.
Crossing cross(const Eigen::AlignedBox2d& plan, const Eigen::Vector2d& direction) {
  Crossing crossing{0.0, std::numeric_limits<double>::infinity()};
  for (int i = 0; i < 2; ++i) {
    if (direction[i] == 0.0) continue;
    const double a = plan.min()[i] / direction[i], b = plan.max()[i] / direction[i];
    crossing.in_m = std::max(crossing.in_m, std::min(a, b));
    crossing.out_m = std::min(crossing.out_m, std::max(a, b));
  }
  return crossing;
}

}  // namespace

Horizon::Horizon() : slope_(kBins, kNothing) {
  for (int bin = 0; bin <= kBins; ++bin) {
    const double angle = 4.0 * bin / kBins;
    const double north = angle <= 2.0 ? 1.0 - angle : angle - 3.0;
    const double east = angle <= 2.0 ? 1.0 - std::abs(north) : std::abs(north) - 1.0;
    edge_dir_.push_back(Eigen::Vector2d(north, east).normalized());
  }
}

void Horizon::reset(const Eigen::Vector3d& eye_W) {
  eye_W_ = eye_W;
  std::fill(slope_.begin(), slope_.end(), kNothing);
}

Eigen::AlignedBox2d Horizon::plan(const Eigen::AlignedBox3f& box_W) const {
  return {box_W.min().head<2>().cast<double>() - eye_W_.head<2>(),
          box_W.max().head<2>().cast<double>() - eye_W_.head<2>()};
}

double Horizon::nearest_m(const Eigen::AlignedBox3f& box_W) const {
  return plan(box_W).exteriorDistance(Eigen::Vector2d::Zero());
}

double Horizon::farthest_m(const Eigen::AlignedBox3f& box_W) const {
  const Eigen::AlignedBox2d box = plan(box_W);
  return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm();
}

Horizon::Span Horizon::span(const Eigen::AlignedBox2d& plan) {
  const Eigen::Vector2d center = plan.center();
  const double middle = square_angle(center.x(), center.y());
  double first = 0.0, last = 0.0;
  for (const double north : {plan.min().x(), plan.max().x()}) {
    for (const double east : {plan.min().y(), plan.max().y()}) {
      double turn = square_angle(north, east) - middle;
      if (turn > 2.0) turn -= 4.0;
      if (turn < -2.0) turn += 4.0;
      first = std::min(first, turn);
      last = std::max(last, turn);
    }
  }
  constexpr double kBinsPerTurn = kBins / 4.0;
  return {(middle + first) * kBinsPerTurn, (middle + last) * kBinsPerTurn};
}

void Horizon::raise(const Eigen::AlignedBox3f& box_W) {
  Eigen::AlignedBox2d box = plan(box_W);
  box.min().array() += kInsetM;
  box.max().array() -= kInsetM;
  const bool eye_below_ground = eye_W_.z() > static_cast<double>(box_W.max().z());
  if (box.isEmpty() || eye_below_ground || box.exteriorDistance(Eigen::Vector2d::Zero()) < kTooNearM) return;

  // A ray in a bin that lies wholly within the box's azimuths meets the box when it passes below the edge of the roof:
  // the near one seen from below, the far one seen from above. Its distance is bounded by those at the bin's ends.
  const double top_m = eye_W_.z() - static_cast<double>(box_W.min().z());
  const Span azimuths = span(box);
  const int first = static_cast<int>(std::ceil(azimuths.first)), last = static_cast<int>(std::floor(azimuths.last));
  for (int bin = first; bin < last; ++bin) {
    const Crossing a = cross(box, edge_dir_[static_cast<size_t>(bin & kBinMask)]);
    const Crossing b = cross(box, edge_dir_[static_cast<size_t>((bin + 1) & kBinMask)]);
    const double edge_m = top_m > 0.0 ? std::max(a.in_m, b.in_m) : std::min(a.out_m, b.out_m) * kBinChord;
    const double slope = top_m / edge_m;
    double& highest = slope_[static_cast<size_t>(bin & kBinMask)];
    highest = std::max(highest, slope - kSlackRad * (1.0 + slope * slope));
  }
}

bool Horizon::hides(const Eigen::AlignedBox3f& box_W) const {
  const double nearest = nearest_m(box_W);
  if (nearest <= 0.0) return false;
  const double top_m = eye_W_.z() - static_cast<double>(box_W.min().z());
  const double slope = top_m / (top_m > 0.0 ? nearest : farthest_m(box_W));
  const Span azimuths = span(plan(box_W));
  const int first = static_cast<int>(std::floor(azimuths.first)), last = static_cast<int>(std::floor(azimuths.last));
  for (int bin = first; bin <= last; ++bin) {
    if (!(slope_[static_cast<size_t>(bin & kBinMask)] > slope)) return false;
  }
  return true;
}

}  // namespace hedgehop::sim
