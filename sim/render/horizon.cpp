#include "sim/render/horizon.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/fields/quantities.h"

namespace hedgehop::sim {

namespace {

constexpr int kBins = 2048;  // each at most 0.22 deg wide; the four cardinal directions are edges of bins
constexpr int kBinMask = kBins - 1;
// Margins. The errors of the rasterizer (1/256 pixel) and of float geometry are far smaller.
constexpr double kInsetM = 0.02;    // a box hides as if each side were moved in by this distance
constexpr double kSlackRad = 1e-3;  // and as if its top were lower by this angle
constexpr double kTooNearM = 1.0;   // the near plane may cut a nearer box open

// The reciprocal of the distance to a side of a box is a sinusoid of the azimuth and concave if positive. Within a bin
// it is therefore at least the lower of its values at the edges of the bin, and at most the higher value divided by
// kChord, which is less than the cosine of half a bin.
constexpr double kChord = 0.999995;

/// Returns a position that increases with the azimuth: 0 north, 1 east, 2 south, 3 west, 4 north again.
double square_angle(const Eigen::Vector2d& direction) {
  const double p = direction.x() / (std::abs(direction.x()) + std::abs(direction.y()));
  return direction.y() >= 0.0 ? 1.0 - p : 3.0 + p;
}

/// Reciprocal distances at which rays from the origin meet the sides of a rectangle, by axis: north, east.
class RectangleSides {
 public:
  /// @param plan  does not contain the origin.
  explicit RectangleSides(const Eigen::AlignedBox2d& plan) {
    for (int i = 0; i < 2; ++i) {
      const double low_m = plan.min()[i], high_m = plan.max()[i];
      enter_[i] = low_m > 0.0 ? 1.0 / low_m : high_m < 0.0 ? 1.0 / high_m : 0.0;
      inside_[i] = enter_[i] == 0.0 ? kInfinity : 0.0;
      leave_high_[i] = high_m > 0.0 ? 1.0 / high_m : 0.0;
      leave_low_[i] = low_m < 0.0 ? 1.0 / low_m : 0.0;
    }
  }

  /// Returns those of the sides that face the origin. A ray enters the rectangle at the smaller of the two. Infinite
  /// for an axis along which the origin is between the sides.
  Eigen::Array2d enter(const Eigen::Array2d& direction) const { return direction * enter_ + inside_; }
  /// Returns those of the opposite sides. A ray leaves the rectangle at the larger of the two.
  Eigen::Array2d leave(const Eigen::Array2d& direction) const {
    return (direction * leave_high_).max(direction * leave_low_);
  }

 private:
  Eigen::Array2d enter_, inside_, leave_high_, leave_low_;
};

}  // namespace

Horizon::Horizon() : bins_(kBins) {
  for (int bin = 0; bin < kBins; ++bin) {
    const double angle = 4.0 * bin / kBins;
    const double north = angle <= 2.0 ? 1.0 - angle : angle - 3.0;
    const double east = angle <= 2.0 ? 1.0 - std::abs(north) : std::abs(north) - 1.0;
    edges_.push_back(Eigen::Vector2d(north, east).normalized());
  }
}

void Horizon::reset(const Eigen::Vector3d& eye_W) {
  eye_W_ = eye_W;
  first_bin_ = 0;
  bin_count_ = kBins;
  std::ranges::fill(bins_, Bin{{-kInfinity, 0.0}, {-kInfinity, 0.0}});
}

void Horizon::limit_to_view(const std::array<Eigen::Vector3d, 4>& corner_rays_W) {
  std::array<Eigen::Vector2d, 4> directions;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (size_t i = 0; i < directions.size(); ++i) {
    directions[i] = corner_rays_W[i].head<2>();
    middle += directions[i];
  }
  // An image of the zenith or the nadir shows all azimuths. Its corners do not fit into half a turn.
  const AzimuthInterval azimuths = interval(middle, directions);
  if (!(azimuths.last - azimuths.first < kBins / 2)) return;
  first_bin_ = static_cast<int>(std::floor(azimuths.first));
  bin_count_ = static_cast<int>(std::floor(azimuths.last)) - first_bin_ + 1;
}

const Eigen::Array2d& Horizon::edge(int bin) const { return edges_[static_cast<size_t>(bin & kBinMask)]; }

bool Horizon::covers(int bin) const { return ((bin - first_bin_) & kBinMask) < bin_count_; }

Eigen::AlignedBox2d Horizon::plan(const Eigen::AlignedBox3f& box_W) const {
  return {box_W.min().head<2>().cast<double>() - eye_W_.head<2>(),
          box_W.max().head<2>().cast<double>() - eye_W_.head<2>()};
}

Horizon::AzimuthInterval Horizon::interval(const Eigen::Vector2d& middle,
                                           const std::array<Eigen::Vector2d, 4>& directions) {
  const double middle_angle = square_angle(middle);
  double first = 0.0, last = 0.0;
  for (const Eigen::Vector2d& direction : directions) {
    double turn = square_angle(direction) - middle_angle;
    if (turn > 2.0) turn -= 4.0;
    if (turn < -2.0) turn += 4.0;
    first = std::min(first, turn);
    last = std::max(last, turn);
  }
  constexpr double kBinsPerSide = kBins / 4.0;
  return {(middle_angle + first) * kBinsPerSide, (middle_angle + last) * kBinsPerSide};
}

Horizon::AzimuthInterval Horizon::interval(const Eigen::AlignedBox2d& plan) {
  using enum Eigen::AlignedBox2d::CornerType;
  return interval(plan.center(),
                  {plan.corner(BottomLeft), plan.corner(BottomRight), plan.corner(TopLeft), plan.corner(TopRight)});
}

void Horizon::add_occluder(const Eigen::AlignedBox3f& box_W) {
  Eigen::AlignedBox2d box = plan(box_W);
  box.min().array() += kInsetM;
  box.max().array() -= kInsetM;
  const bool eye_below_ground = height_above_eye_m(box_W.max().z()) > 0.0;
  if (box.isEmpty() || eye_below_ground || box.exteriorDistance(Eigen::Vector2d::Zero()) < kTooNearM) return;

  // Consider a bin that is completely within the azimuths of the box. Its rays meet the box if they pass below the edge
  // of the roof: the near edge if the camera is below the roof, the far edge if it is above.
  const double top_m = height_above_eye_m(box_W.min().z());
  const RectangleSides sides(box);
  const AzimuthInterval azimuths = interval(box);
  const int first = static_cast<int>(std::ceil(azimuths.first)), last = static_cast<int>(std::floor(azimuths.last));
  for (int bin = first; bin < last; ++bin) {
    if (!covers(bin)) continue;
    const Eigen::Array2d &a = edge(bin), &b = edge(bin + 1);
    Occluder screen;
    if (top_m > 0.0) {
      screen.reciprocal_pm = sides.enter(a).min(sides.enter(b)).minCoeff();
      screen.slope = top_m * screen.reciprocal_pm;
    } else {
      const Eigen::Array2d at_a = sides.leave(a), at_b = sides.leave(b);
      screen.reciprocal_pm = at_a.min(at_b).maxCoeff();
      screen.slope = top_m * at_a.max(at_b).maxCoeff() / kChord;
    }
    screen.slope -= kSlackRad * (1.0 + screen.slope * screen.slope);
    Bin& stored = bins_[static_cast<size_t>(bin & kBinMask)];
    if (screen.slope > stored.highest.slope) std::swap(screen, stored.highest);
    if (screen.slope > stored.second.slope) stored.second = screen;
  }
}

bool Horizon::hides(const Eigen::AlignedBox3f& box_W) const {
  const Eigen::AlignedBox2d box = plan(box_W);
  const double nearest_m = box.exteriorDistance(Eigen::Vector2d::Zero());
  if (nearest_m <= 0.0) return false;
  const double farthest_m = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm();
  const double top_m = height_above_eye_m(box_W.min().z());
  const RectangleSides sides(box);
  const AzimuthInterval azimuths = interval(box);
  const int first = static_cast<int>(std::floor(azimuths.first)), last = static_cast<int>(std::floor(azimuths.last));
  for (int bin = first; bin <= last; ++bin) {
    if (!covers(bin)) continue;
    // Upper bound of the slope of the box in this bin: its top at the minimum distance if the top is above the camera,
    // at the maximum distance if it is below.
    const Eigen::Array2d &a = edge(bin), &b = edge(bin + 1);
    const double enter_pm = sides.enter(a).max(sides.enter(b)).minCoeff() / kChord;
    const double leave_pm = sides.leave(a).min(sides.leave(b)).maxCoeff();
    const double nearest_pm = enter_pm > 0.0 ? std::min(enter_pm, 1.0 / nearest_m) : 1.0 / nearest_m;
    const double slope = top_m * (top_m > 0.0 ? nearest_pm : std::max(leave_pm, 1.0 / farthest_m));
    const auto hidden_by = [&](const Occluder& screen) {
      return slope < screen.slope && nearest_pm <= screen.reciprocal_pm;
    };
    const Bin& stored = bins_[static_cast<size_t>(bin & kBinMask)];
    if (!hidden_by(stored.highest) && !hidden_by(stored.second)) return false;
  }
  return true;
}

}  // namespace hedgehop::sim
