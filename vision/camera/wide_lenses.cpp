#include "vision/camera/wide_lenses.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "sim/libm/many.h"

namespace hedgehop::vision::camera {
namespace {

/// Returns the root of a function that increases over [low, high], by Newton's method with bisection if a step leaves
/// the bracketing interval. @param f  (x) -> pair of value and slope; f(low) <= 0 <= f(high).
template <class Function>
double rising_root(const Function& f, double low, double high, double guess) {
  constexpr int kMaxSteps = 80;     // bisection alone needs 60
  constexpr double kClose = 1e-13;  // the next step would be far below rounding
  double x = guess > low && guess < high ? guess : 0.5 * (low + high);
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto [value, slope] = f(x);
    (value > 0.0 ? high : low) = x;
    double next = x - value / slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const double moved = std::abs(next - x);
    x = next;
    if (moved <= kClose * std::abs(x)) break;
  }
  return x;
}

}  // namespace

double FisheyeLens::radius(double angle_rad) const {
  const double s = angle_rad * angle_rad;
  return angle_rad * (1.0 + s * (k1 + s * (k2 + s * (k3 + s * k4))));
}

double FisheyeLens::radius_slope(double angle_rad) const {
  const double s = angle_rad * angle_rad;
  return 1.0 + s * (3.0 * k1 + s * (5.0 * k2 + s * (7.0 * k3 + s * 9.0 * k4)));
}

double FisheyeLens::growth_limit_rad() const {
  constexpr double kStepRad = 1e-4;
  double angle_rad = 0.0;
  while (angle_rad < std::numbers::pi && radius_slope(angle_rad + kStepRad) > 0.0) angle_rad += kStepRad;
  return std::fmin(angle_rad, std::numbers::pi);
}

namespace {

/// Projects a point at a known distance from the axis and angle off the axis.
std::optional<Eigen::Vector2d> project_at(const FisheyeLens& lens, const Eigen::Vector3d& p_C, double aside,
                                          double angle_rad) {
  if (!(angle_rad < lens.limit_rad) || !(p_C.squaredNorm() > 0.0)) return std::nullopt;
  if (aside == 0.0) return Eigen::Vector2d{lens.center_u_px, lens.center_v_px};
  const double scale = lens.radius(angle_rad) / aside;
  return Eigen::Vector2d{lens.center_u_px + lens.focal_x_px * scale * p_C.x(),
                         lens.center_v_px + lens.focal_y_px * scale * p_C.y()};
}

}  // namespace

std::optional<Eigen::Vector2d> FisheyeLens::project(const Eigen::Vector3d& p_C) const {
  const double aside = p_C.head<2>().norm();
  return project_at(*this, p_C, aside, std::atan2(aside, p_C.z()));
}

void FisheyeLens::project_each(std::span<const Eigen::Vector3d> points_C, std::span<Eigen::Vector2d> pixels) const {
  constexpr size_t kAtOnce = 64;
  std::array<double, kAtOnce> asides, ahead, angles_rad;
  for (size_t begin = 0; begin < points_C.size(); begin += kAtOnce) {
    const auto points = points_C.subspan(begin, std::min(kAtOnce, points_C.size() - begin));
    for (size_t i = 0; i < points.size(); ++i) {
      asides[i] = points[i].head<2>().norm();
      ahead[i] = points[i].z();
    }
    atan2_of_each({asides.data(), points.size()}, {ahead.data(), points.size()}, {angles_rad.data(), points.size()});
    for (size_t i = 0; i < points.size(); ++i) {
      pixels[begin + i] = project_at(*this, points[i], asides[i], angles_rad[i]).value_or(kNoPixel);
    }
  }
}

std::optional<Eigen::Vector3d> FisheyeLens::unit_ray(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d seen((pixel.x() - center_u_px) / focal_x_px, (pixel.y() - center_v_px) / focal_y_px);
  const double seen_radius = seen.norm();
  if (!(seen_radius < radius(limit_rad))) return std::nullopt;
  if (seen_radius == 0.0) return Eigen::Vector3d::UnitZ();
  const double angle_rad = rising_root([&](double a) { return std::pair(radius(a) - seen_radius, radius_slope(a)); },
                                       0.0, limit_rad, seen_radius);
  const Eigen::Vector2d aside = seen * (std::sin(angle_rad) / seen_radius);
  return Eigen::Vector3d(aside.x(), aside.y(), std::cos(angle_rad)).normalized();
}

namespace {

void require(bool holds, const std::string& fault) {
  if (!holds) throw std::invalid_argument("OCamCalib calibration: " + fault);
}

/// Returns the next row of numbers, without empty lines and comments.
std::vector<double> next_row(std::istream& lines, const std::string& what) {
  std::string line;
  while (std::getline(lines, line)) {
    const size_t start = line.find_first_not_of(" \t\r");
    if (start == std::string::npos || line[start] == '#') continue;
    std::istringstream words(line);
    std::vector<double> row;
    for (double number = 0.0; words >> number;) row.push_back(number);
    require(words.eof() && std::ranges::all_of(row, [](double x) { return std::isfinite(x); }),
            what + ": expected numbers, got '" + line + "'");
    return row;
  }
  throw std::invalid_argument("OCamCalib calibration: ends before its " + what);
}

std::vector<double> next_row(std::istream& lines, const std::string& what, size_t size) {
  std::vector<double> row = next_row(lines, what);
  require(row.size() == size,
          what + ": expected " + std::to_string(size) + " numbers, got " + std::to_string(row.size()));
  return row;
}

std::vector<double> next_polynomial(std::istream& lines, const std::string& what) {
  std::vector<double> row = next_row(lines, what);
  require(row.size() >= 2 && row.front() == static_cast<double>(row.size() - 1),
          what + ": its first number must count the coefficients that follow");
  row.erase(row.begin());
  return row;
}

/// Returns the value of f and its slope.
std::pair<double, double> evaluate(const std::array<double, OcamLens::kMaxCoefficients>& coefficients, double x) {
  double value = 0.0, slope = 0.0;
  for (auto coefficient = coefficients.rbegin(); coefficient != coefficients.rend(); ++coefficient) {
    slope = slope * x + value;
    value = value * x + *coefficient;
  }
  return {value, slope};
}

Eigen::Matrix2d affine(const OcamLens& lens) { return (Eigen::Matrix2d() << lens.c, lens.d, lens.e, 1.0).finished(); }

}  // namespace

OcamCalibration parse_ocam_calibration(const std::string& text) {
  std::istringstream lines(text);
  OcamCalibration calibration;
  calibration.direct = next_polynomial(lines, "direct polynomial");
  calibration.inverse = next_polynomial(lines, "inverse polynomial");
  const std::vector<double> center = next_row(lines, "center", 2);
  const std::vector<double> affine = next_row(lines, "affine parameters", 3);
  const std::vector<double> size = next_row(lines, "image size", 2);
  constexpr double kMaxPixels = 32768.0;
  const auto is_size = [](double x) { return x >= 1.0 && x <= kMaxPixels && x == std::floor(x); };
  require(is_size(size[0]) && is_size(size[1]), "image size: must be whole numbers of pixels");
  calibration.center_row_px = center[0];
  calibration.center_col_px = center[1];
  calibration.c = affine[0];
  calibration.d = affine[1];
  calibration.e = affine[2];
  calibration.height_px = static_cast<int>(size[0]);
  calibration.width_px = static_cast<int>(size[1]);
  return calibration;
}

double OcamLens::angle_rad(double radius_px) const { return std::atan2(radius_px, -evaluate(direct, radius_px).first); }

std::optional<Eigen::Vector2d> OcamLens::project(const Eigen::Vector3d& p_C) const {
  const double aside = p_C.head<2>().norm();
  const double angle = std::atan2(aside, p_C.z()), limit_rad = angle_rad(limit_px);
  if (!(angle < limit_rad) || !(p_C.squaredNorm() > 0.0)) return std::nullopt;
  if (aside == 0.0) return Eigen::Vector2d{center_col_px, center_row_px};
  const auto too_wide = [&](double radius_px) {
    const auto [f, slope] = evaluate(direct, radius_px);
    return std::pair(std::atan2(radius_px, -f) - angle, (radius_px * slope - f) / (radius_px * radius_px + f * f));
  };
  const double radius_px = rising_root(too_wide, 0.0, limit_px, limit_px * angle / limit_rad);
  const double x = radius_px * p_C.y() / aside, y = radius_px * p_C.x() / aside;
  return Eigen::Vector2d{center_col_px + e * x + y, center_row_px + c * x + d * y};
}

std::optional<Eigen::Vector3d> OcamLens::unit_ray(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d xy =
      affine(*this).inverse() * Eigen::Vector2d(pixel.y() - center_row_px, pixel.x() - center_col_px);
  const double radius_px = xy.norm();
  if (!(radius_px < limit_px)) return std::nullopt;
  return Eigen::Vector3d(xy.y(), xy.x(), -evaluate(direct, radius_px).first).normalized();
}

OcamLens ocam_lens(const OcamCalibration& calibration) {
  require(!calibration.direct.empty() && calibration.direct.size() <= OcamLens::kMaxCoefficients,
          "the direct polynomial must have 1 to " + std::to_string(OcamLens::kMaxCoefficients) + " coefficients");
  require(calibration.direct[0] < 0.0, "the direct polynomial must begin below 0");
  OcamLens lens;
  std::ranges::copy(calibration.direct, lens.direct.begin());
  lens.center_row_px = calibration.center_row_px;
  lens.center_col_px = calibration.center_col_px;
  lens.c = calibration.c;
  lens.d = calibration.d;
  lens.e = calibration.e;
  require(affine(lens).determinant() > 0.0, "the affine parameters must not mirror or flatten the image");

  double corner_px = 0.0;
  for (const double row : {-0.5, calibration.height_px - 0.5}) {
    for (const double col : {-0.5, calibration.width_px - 0.5}) {
      const Eigen::Vector2d from_center(row - lens.center_row_px, col - lens.center_col_px);
      corner_px = std::max(corner_px, (affine(lens).inverse() * from_center).norm());
    }
  }
  constexpr double kStepPx = 0.25, kPastPx = 1.0;  // beyond the corner, for the neighbors of its pixel
  while (lens.limit_px < corner_px + kPastPx &&
         lens.angle_rad(lens.limit_px + kStepPx) > lens.angle_rad(lens.limit_px)) {
    lens.limit_px += kStepPx;
  }
  require(lens.limit_px > 0.0, "the angle off the axis must grow from the center outwards");
  return lens;
}

}  // namespace hedgehop::vision::camera
