#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <opencv2/core.hpp>
#include <span>
#include <string>

#include "sim/record/run_record.h"
#include "sim/scenario/rig.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim {

/// Returns the cameras of a rig for the replay (web/src/replay_screens.js): `role`, pose in B (`p`, m; `q`: x, y, z,
/// w), vertical field of view `fov_deg`, `rays` of a grid of `columns` x `rows` pixels in B (null outside the image
/// circle) and its place `sheet` (x, y, width, height, as shares) in the image of all cameras.
nlohmann::ordered_json replay_cameras(const RigConfig& rig);

/// Returns one image with the images of all cameras in their channels, CV_8UC3, RGB; empty without a camera.
/// @param pose  of the vehicle; null: the flight's own instant.
cv::Mat camera_sheet(Simulation& simulation, const ChosenPose* pose);

/// The images of all cameras along a recorded path.
struct CameraFilm {
  std::string bytes;     ///< of a WebM film; empty without cameras or path, and after a fault
  double rate_hz = 0.0;  ///< images per second
  std::string fault;     ///< reason why there is no film, such as an invalid scenario or a missing encoder; else empty
};

/// Renders the images of all cameras along the recorded path, at most 600 instants, with the imperfections of the
/// sensor at rest. @param folder  of the run, for the film until it is read.
CameraFilm camera_film(const RunRecord& run, const std::filesystem::path& folder);

}  // namespace hedgehop::sim
