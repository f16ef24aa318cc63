#pragma once

#include <Eigen/Core>
#include <numbers>
#include <vector>

#include "vision/corridor/corridor_regions.h"
#include "vision/flow/feature_flow.h"

/// From tracked corners to positions of walls. Frame H: level, x along the heading, y to the right.
namespace hedgehop::vision::corridor {

/// Which flow is rejected: by the two filters of [Zingg2010] sec. IV-D, whose first limit is not printed, and by ours.
struct FlowLimits {
  double slowest_radps = 0.05;  ///< below, noise of the images decides
  double fastest_radps = 3.0;
  double off_tangent_rad = 50.0 * std::numbers::pi / 180.0;  ///< at the sides
  double stray_rad = 30.0 * std::numbers::pi / 180.0;
  double floor_share = 0.85;  ///< of the height above ground: what lies lower is the floor
};

template <class Visitor>
void describe(Visitor& v, FlowLimits& c) {
  v("slowest", c.slowest_radps,
    {.unit = "rad/s", .at_least = 0.0, .meaning = "slower flow is rejected: noise decides it"});
  v("fastest", c.fastest_radps, {.unit = "rad/s", .above = 0.0, .meaning = "faster flow is rejected as a wrong match"});
  v("off_tangent", c.off_tangent_rad,
    {.unit = "deg",
     .above = 0.0,
     .at_most = 90.0,
     .meaning = "at the sides, greatest angle of the flow to a circle round the image's center; 90: any"});
  v("stray", c.stray_rad,
    {.unit = "deg",
     .above = 0.0,
     .at_most = 180.0,
     .meaning = "greatest angle between the flow and the direction in which fixed points move; 180: any"});
  v("floor_share", c.floor_share,
    {.above = 0.0, .meaning = "what lies lower than this share of the height above ground is the floor"});
}

/// How the camera moved between the older image (C1) and the newer (C2).
struct CameraMotion {
  Eigen::Matrix3d R_HC1, R_HC2;  ///< H at the newer image
  Eigen::Vector3d traveled_H;    ///< m
  double dt_s = 0.0;             ///< > 0
  double height_m = 0.0;         ///< of the camera above ground at the newer image
};

/// Why a flow vector does not count; `none` for one that does.
enum class RejectionReason { none, too_slow, too_fast, off_tangent, outlier, floor };

/// A tracked corner and what its flow measures.
struct WallPoint {
  flow::RayPair pair;
  Region region = kAhead;
  RejectionReason rejection = RejectionReason::none;
  double flow_radps = 0.0;                           ///< derotated
  double off_travel_rad = 0.0;                       ///< angle from the direction of travel to the older ray
  double contact_s = 0.0;                            ///< until it lies abeam, as time_to_contact_s()
  Eigen::Vector3d p_CP_H = Eigen::Vector3d::Zero();  ///< from the camera at the newer image, m
};

/// Returns the point that a corner's flow measures, and whether it is rejected.
/// Source: [Zingg2010] eq. (2), (5) to (7), (9) and sec. IV-D.
WallPoint wall_point(const flow::RayPair& pair, Region region, const camera::Camera& camera, const CameraMotion& motion,
                     const FlowLimits& limits);

/// Distance of the wall at one side.
struct SideDistance {
  double distance_m = 0.0;  ///< NaN when unknown
  int count = 0;            ///< accepted points of the side
};

/// Returns the median of |y| over a side's accepted points; unknown when they are fewer than `least` (>= 1).
/// Source: [Zingg2010] sec. IV-E.
SideDistance side_distance(const std::vector<WallPoint>& points, Region side, int least);

/// Returns how far the corridor's middle lies to the right, m. NaN when a side is unknown. Source: [Zingg2010] eq.
/// (10).
double middle_offset_m(double left_m, double right_m);
/// Returns that as a share of half the corridor's width, from -1 at the right wall to 1 at the left; the unknown speed
/// cancels. NaN when a side is unknown. Source: [Zingg2010] eq. (11).
double centering_error(double left_m, double right_m);

/// How the free width ahead is measured; all of it is ours.
struct GapConfig {
  double behind_m = 0.4, ahead_m = 2.0;  ///< from the camera
  double slice_m = 0.4;
  double share = 0.2;                                  ///< of a slice's points that may lie nearer: wrong ones
  double least_rad = 15.0 * std::numbers::pi / 180.0;  ///< from the direction of travel: nearer, the flow is noise
  int least = 6;                                       ///< points that a slice, or a free time, needs
};

template <class Visitor>
void describe(Visitor& v, GapConfig& c) {
  v("behind", c.behind_m, {.unit = "m", .at_least = 0.0, .meaning = "how far behind the camera the gap is measured"});
  v("ahead", c.ahead_m, {.unit = "m", .above = 0.0, .meaning = "how far ahead of the camera the gap is measured"});
  v("slice", c.slice_m, {.unit = "m", .above = 0.0, .meaning = "length of the slices in which the gap is measured"});
  v("share", c.share,
    {.at_least = 0.0, .below = 0.5, .meaning = "share of a slice's points, the nearest, left out as outliers"});
  v("least_angle", c.least_rad,
    {.unit = "deg",
     .at_least = 0.0,
     .at_most = 90.0,
     .meaning = "points closer to the direction of travel do not count for the gap"});
  v("least", c.least, {.at_least = 1, .meaning = "points that a slice must have to count"});
}

/// Free distance to the left and right over the measured length, m; NaN where no slice has enough points.
struct Gap {
  double left_m = 0.0, right_m = 0.0;
};
/// Returns the smallest free distance of all slices, on each side.
Gap gap_ahead(const std::vector<WallPoint>& points, const GapConfig& config);

/// Returns the time after which a fixed point lies abeam, s, < 0 for a point behind, +inf without flow: straight ahead
/// two over the flow's divergence. Parameters as distance_m(); only the direction of `traveled` counts.
double time_to_contact_s(const Eigen::Vector3d& before, const Eigen::Vector3d& after, const Eigen::Vector3d& traveled,
                         double dt_s);

/// Returns the time until `least` accepted points are met, s, by a body of the given half width that flies straight
/// on; +inf when it meets fewer. @param direction_H  direction of travel, not 0.
double free_time_s(const std::vector<WallPoint>& points, const Eigen::Vector2d& direction_H, double half_width_m,
                   int least);

}  // namespace hedgehop::vision::corridor
