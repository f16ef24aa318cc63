#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <numbers>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/fields/field.h"
#include "vision/camera/camera.h"
#include "vision/flow/feature_flow.h"

namespace hedgehop::vision::corridor {

/// The parts of the view that are searched for walls. Azimuth from B's x axis, elevation from B's x-y plane upwards.
/// Source: [Zingg2010] sec. IV-D and fig. 7: two segments of 80 deg, without 50 deg ahead. The elevations are not from
/// the paper.
struct CorridorRegions {
  double ahead_rad = 25.0 * std::numbers::pi / 180.0;  ///< excluded on each side of the direction of travel
  double segment_rad = 80.0 * std::numbers::pi / 180.0;
  double lowest_rad = -25.0 * std::numbers::pi / 180.0;
  double highest_rad = 5.0 * std::numbers::pi / 180.0;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<CorridorRegions> auto& c) {
  v("ahead", c.ahead_rad,
    {.unit = "deg", .at_least = 0.0, .at_most = 90.0, .meaning = "angle excluded on each side of the nose"});
  v("segment", c.segment_rad,
    {.unit = "deg", .above = 0.0, .at_most = 180.0, .meaning = "angular width of each side's view"});
  v("lowest", c.lowest_rad,
    {.unit = "deg", .at_least = -90.0, .at_most = 90.0, .meaning = "minimum elevation searched for walls"});
  v("highest", c.highest_rad,
    {.unit = "deg", .at_least = -90.0, .at_most = 90.0, .meaning = "maximum elevation searched for walls"});
}

/// Indices into the array that region_masks() returns.
enum Region { kLeft, kRight, kAhead, kRegions };

/// Returns the masks of the regions: CV_8UC1 of the image's size, 255 inside.
/// @param X_BC  pose of the camera in B.
/// @param rim_px  pixels this close to the border of the image or of the lens's image circle are excluded, >= 0.
/// Throws std::invalid_argument on angles that leave a region empty.
std::array<cv::Mat, kRegions> region_masks(const camera::Camera& camera, const Eigen::Isometry3d& X_BC,
                                           const CorridorRegions& regions, int rim_px);

/// Limits for the rejection of flow vectors: the two filters of [Zingg2010] sec. IV-D, whose first limit is not
/// printed, and our additional ones.
struct FlowLimits {
  double slowest_radps = 0.05;  ///< image noise dominates slower flow
  double fastest_radps = 3.0;
  double off_tangent_rad = 50.0 * std::numbers::pi / 180.0;  ///< at the sides
  double stray_rad = 30.0 * std::numbers::pi / 180.0;
  double floor_share = 0.85;  ///< share of the height above ground; lower points belong to the floor
};

/// Motion of the camera between the older image (C1) and the newer one (C2). Frame H: level, x along the heading, y to
/// the right.
struct CameraMotion {
  Eigen::Matrix3d R_HC1, R_HC2;  ///< H at the newer image
  Eigen::Vector3d traveled_H;    ///< m
  double dt_s = 0.0;             ///< > 0
  double height_m = 0.0;         ///< of the camera above ground at the newer image
};

/// Reason for the rejection of a flow vector; `none` if it is accepted.
enum class RejectionReason { none, too_slow, too_fast, off_tangent, outlier, floor };

/// A tracked corner and the point that its flow measures.
struct WallPoint {
  flow::RayPair pair;
  Region region = kAhead;
  RejectionReason rejection = RejectionReason::none;
  double flow_radps = 0.0;                           ///< derotated
  double off_travel_rad = 0.0;                       ///< angle from the direction of travel to the older ray
  double contact_s = 0.0;                            ///< time until it is abeam, as time_to_contact_s()
  Eigen::Vector3d p_CP_H = Eigen::Vector3d::Zero();  ///< from the camera at the newer image, m
};

/// Returns the point that a corner's flow measures, and whether it is rejected.
/// Source: [Zingg2010] eq. (2), (5) to (7), (9) and sec. IV-D.
WallPoint wall_point(const flow::RayPair& pair, Region region, const camera::Camera& camera, const CameraMotion& motion,
                     const FlowLimits& limits);

/// Distance of the wall on one side.
struct SideDistance {
  double distance_m = 0.0;  ///< NaN if unknown
  int count = 0;            ///< number of accepted points on the side
};

/// Returns the median of |y| over a side's accepted points; unknown if there are fewer than `min_count` (>= 1).
/// Source: [Zingg2010] sec. IV-E.
SideDistance side_distance(const std::vector<WallPoint>& points, Region side, int min_count);

/// Returns the offset of the corridor's centerline to the right, m; NaN if a side is unknown.
/// Source: [Zingg2010] eq. (10).
double middle_offset_m(double left_m, double right_m);
/// Returns this offset as a share of half the corridor's width, from -1 at the right wall to 1 at the left; NaN if a
/// side is unknown. The unknown speed cancels. Source: [Zingg2010] eq. (11).
double centering_error(double left_m, double right_m);

/// Returns the time until a fixed point is abeam, s; < 0 for a point behind, +inf without flow. Straight ahead it
/// equals two divided by the flow's divergence. Parameters as for distance_m(); only the direction of `traveled`
/// matters.
double time_to_contact_s(const Eigen::Vector3d& before, const Eigen::Vector3d& after, const Eigen::Vector3d& traveled,
                         double dt_s);

}  // namespace hedgehop::vision::corridor
