// Depth from the motion of one camera, in rendered images with a sensor's noise, against the depth that was drawn.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <random>
#include <string>
#include <vector>

#include "scenes/generators.h"
#include "sim/loop/imperfections.h"
#include "sim/render/renderer.h"
#include "sim/scenario/rig.h"
#include "sim/scenario/scenario.h"
#include "vision/camera/pinhole_camera.h"
#include "vision/motion/plane_sweep.h"

namespace hedgehop::sim {
namespace {

using vision::motion::PlaneSweep;

constexpr int kParkPairs = 28;
constexpr int kMaxDraws = 1000;  // of poses; those next to a surface give no pair
constexpr double kParkBaselineM = 1.6;
constexpr double kParkSpeedMps = 4.8;
constexpr double kVelocityErrorMps = 0.02;  // 1-sigma, per axis, constant between the images of a pair
constexpr double kOutlierSigmas = 4.0;
constexpr double kMinMatchedShare = 0.6;  // docs/local-map.md: minimum 0.67

/// Errors of matched pixels at some distance from the focus of expansion.
struct SigmaRing {
  double first_px = 0.0, end_px = 0.0;  ///< of the distance, pixels of the camera
  int pixels = 0, matched = 0, beyond = 0, too_far = 0;
  double sum_squares = 0.0;     ///< of errors divided by sigma, within 4 sigma
  std::vector<float> of_depth;  ///< sigma of the depth as a share of the depth

  double deviation() const { return std::sqrt(sum_squares / (matched - beyond)); }
  double share_beyond() const { return static_cast<double>(beyond) / matched; }
  double share_too_far() const { return static_cast<double>(too_far) / matched; }
  double median_share() {
    const auto middle = of_depth.begin() + static_cast<std::ptrdiff_t>(of_depth.size() / 2);
    std::nth_element(of_depth.begin(), middle, of_depth.end());
    return *middle;
  }
};

/// Renders and matches pairs of images along the route of the park of `local_map_motion_park`, with its camera and
/// noise.
class ParkFlight {
 public:
  ParkFlight()
      : park_(load_scenario(HEDGEHOP_SOURCE_DIR "/configs/local_map_motion_park.yaml",
                            std::vector<std::string>{"seed=3"})),
        front_(*park_.rig.find("front")),
        camera_(front_.model().pinhole()),
        renderer_(scenes::make_scene(park_.scene, park_.seed), Culling::frustum_and_horizon, RendererKind::tiles),
        sensor_(*front_.imperfections, 1.0 / front_.rate_hz, 1) {}

  /// Adds the errors of one pair to the rings. Returns whether there was a pair: none next to a surface.
  bool add_pair(std::vector<SigmaRing>& rings) {
    const Eigen::Isometry3d X_WCk = draw_pose();
    const Eigen::Vector3d ahead_W = X_WCk.linear().col(2), side_W = X_WCk.linear().col(0);
    Eigen::Isometry3d X_WC = X_WCk;
    X_WC.pretranslate(kParkBaselineM * (ahead_W + 0.1 * normal_(random_) * side_W).normalized());
    X_WC.rotate(Eigen::AngleAxisd(0.03 * normal_(random_), Eigen::Vector3d::UnitY()));
    cv::Mat depth_m;
    renderer_.draw({camera_, X_WC, ImageChannel::depth}, depth_m);
    if (is_near(depth_m)) return false;
    const cv::Mat key = photo(X_WCk), here = photo(X_WC);
    const double apart_s = kParkBaselineM / kParkSpeedMps;
    const Eigen::Isometry3d X_CCk = X_WC.inverse() * X_WCk;
    const Eigen::Vector3d error_m =
        kVelocityErrorMps * apart_s * Eigen::Vector3d(normal_(random_), normal_(random_), normal_(random_));
    const vision::motion::CameraMotion motion{X_CCk.linear(), X_CCk.translation() + error_m,
                                              kVelocityErrorMps * apart_s, 0.0};
    PlaneSweep sweep(camera_, {});
    add(sweep.match(PlaneSweep::smooth(here), PlaneSweep::smooth(key), motion), depth_m, X_CCk.translation(), rings);
    return true;
  }

 private:
  Eigen::Isometry3d draw_pose() {
    const double share = std::uniform_real_distribution(0.0, 0.9)(random_);
    const double north_m = park_.start.north_m + share * (park_.goal->north_m - park_.start.north_m);
    const double east_m =
        park_.start.east_m + share * (park_.goal->east_m - park_.start.east_m) + 3.0 * normal_(random_);
    const double heading_rad = 0.26 + 0.3 * normal_(random_);  // of the route, and turns
    Eigen::Isometry3d X_WC(Eigen::Translation3d(north_m, east_m, -park_.start.altitude_m));
    X_WC.linear() << -std::sin(heading_rad), 0, std::cos(heading_rad),  //
        std::cos(heading_rad), 0, std::sin(heading_rad),                //
        0, 1, 0;
    return X_WC;
  }

  cv::Mat photo(const Eigen::Isometry3d& X_WC) {
    cv::Mat grey;
    renderer_.draw({camera_, X_WC, ImageChannel::grey}, grey);
    sensor_.apply(++images_, grey);
    return grey;
  }

  /// Whether a surface is closer than the baselines that a flight chooses: 0.3 of the distance.
  static bool is_near(const cv::Mat& depth_m) {
    const cv::Mat near = depth_m < kParkBaselineM / 0.3;
    return cv::countNonZero(near) > 0.02 * static_cast<double>(depth_m.total());
  }

  void add(const vision::motion::InverseDepth& found, const cv::Mat& depth_m, const Eigen::Vector3d& p_CCk,
           std::vector<SigmaRing>& rings) const {
    const double focus_u = camera_.center_u_px + camera_.focal_x_px * p_CCk.x() / p_CCk.z();
    const double focus_v = camera_.center_v_px + camera_.focal_y_px * p_CCk.y() / p_CCk.z();
    for (int v = 0; v < found.per_m.rows; ++v) {
      for (int u = 0; u < found.per_m.cols; ++u) {
        const float z_m = depth_m.at<float>(2 * v, 2 * u);
        if (!std::isfinite(z_m)) continue;  // sky
        const double away_px = std::hypot(2 * u + 0.5 - focus_u, 2 * v + 0.5 - focus_v);
        for (SigmaRing& ring : rings) {
          if (away_px >= ring.first_px && away_px < ring.end_px) {
            add(found.per_m.at<float>(v, u), found.sigma_per_m.at<float>(v, u), 1.0F / z_m, ring);
          }
        }
      }
    }
  }

  static void add(float per_m, float sigma_per_m, float truth_per_m, SigmaRing& ring) {
    ++ring.pixels;
    if (std::isnan(per_m)) return;
    ++ring.matched;
    const double error = (per_m - truth_per_m) / sigma_per_m;
    ring.of_depth.push_back(sigma_per_m / truth_per_m);
    if (std::abs(error) > kOutlierSigmas) {
      ++ring.beyond;
      ring.too_far += error < 0.0 ? 1 : 0;
    } else {
      ring.sum_squares += error * error;
    }
  }

  Scenario park_;
  const CameraConfig& front_;
  vision::camera::PinholeCamera camera_;
  Renderer renderer_;
  Imperfections sensor_;
  int64_t images_ = 0;
  std::mt19937_64 random_{1};
  std::normal_distribution<double> normal_;
};

// docs/local-map.md has the rows. A map tolerates such outliers: it needs two in one place.
TEST(RenderedMotion, ErrorsInTheParkHaveTheStatedSigmaAtEveryDistanceFromTheFocusOfExpansion) {
  ParkFlight flight;
  std::vector<SigmaRing> rings;
  for (double px = 16.0; px < 500.0; px *= 2.0) rings.push_back({px, px < 200.0 ? 2.0 * px : 1e9});
  int pairs = 0;
  for (int i = 0; i < kMaxDraws && pairs < kParkPairs; ++i) pairs += flight.add_pair(rings) ? 1 : 0;
  ASSERT_EQ(pairs, kParkPairs);
  for (SigmaRing& ring : rings) {
    ASSERT_GT(ring.matched, kMinMatchedShare * ring.pixels) << "from " << ring.first_px << " px";
    const std::string row =
        fmt::format("| {:.0f} px | {:.0f} % | {:.2f} | {:.1f} % | {:.1f} % | {:.1f} % |", ring.first_px,
                    1e2 * ring.matched / ring.pixels, ring.deviation(), 1e2 * ring.share_beyond(),
                    1e2 * ring.share_too_far(), 1e2 * ring.median_share());
    RecordProperty(fmt::format("from_{:.0f}_px", ring.first_px), row);
    EXPECT_GT(ring.deviation(), 0.7) << row;
    EXPECT_LT(ring.deviation(), 1.5) << row;
    EXPECT_LT(ring.share_beyond(), 0.12) << row;
    EXPECT_LT(ring.share_too_far(), 0.04) << row;
  }
}

}  // namespace
}  // namespace hedgehop::sim
