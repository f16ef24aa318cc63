#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "scenes/scene.h"
#include "vision/camera/camera.h"

// Scenes, camera poses and cameras of render_bench.
namespace hedgehop::sim {

using Poses = std::vector<Eigen::Isometry3d>;  ///< X_WC

constexpr double kFlightHeightM = 10.0;

scenes::Scene city(double extent_m);  ///< some 100 buildings in 300 m, 10,000 in 3000 m
scenes::Scene room();
scenes::Scene forest(int64_t trees);
/// A plane kFlightHeightM below the eye with 1.6 texels to each pixel of floor_camera(), so that every pixel is
/// filtered between two mipmap levels.
scenes::Scene full_screen_quad();

/// Eight headings at each of six crossings near the middle, the same for every size of city.
Poses street_views(double height_m);
/// Left, right, front, rear and down, all along a flight.
Poses five_cameras_in_flight();
Poses room_views();
/// Eight headings at each of five places near the middle, the same for every size of forest.
Poses forest_views(double height_m);
/// From above full_screen_quad().
Eigen::Isometry3d quad_view();

vision::camera::PinholeCamera right_angle_pinhole(int width_px, int height_px);  ///< 90 degrees wide
/// right_angle_pinhole(400, 400) with a common lens before it.
vision::camera::Camera distorted_pinhole();
/// 752 x 480 px and 190 degrees across.
vision::camera::Camera wide_fisheye();
/// A pinhole of any size with the focal length of right_angle_pinhole(400, 400).
vision::camera::Camera floor_camera(int width_px, int height_px);

}  // namespace hedgehop::sim
