#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "sim/dataset/dataset.h"
#include "sim/loop/cameras.h"
#include "sim/loop/flight_environment.h"
#include "sim/scenario/flight_parts.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// An image of a data set: the body's motion then, and its pose at the next image, for the optic flow.
struct Shot {
  Cameras::Instant now;
  std::optional<Cameras::Instant> next;
};

/// A world of a data set and the camera that draws its images. The scene is made once.
class DrawnWorld {
 public:
  /// Throws InputError as load_flight(), and for a camera that the rig lacks. @param request  outlives the world.
  DrawnWorld(const DatasetRequest& request, const std::filesystem::path& scenario, uint64_t seed);

  const Scenario& scenario() const { return scenario_; }
  const scenes::Scene& scene() const { return *environment_.scene; }
  const CameraConfig& camera() const { return scenario_.rig.cameras[camera_]; }

  /// Returns the instants of the images. @param count  0: all poses of the file. Throws InputError as random_poses()
  /// and parse_poses().
  std::vector<Shot> shots(size_t count);

  /// Returns an image as it is stored.
  cv::Mat image(DatasetChannel channel, const Shot& shot);

 private:
  DrawnWorld(const DatasetRequest& request, LoadedScenario loaded);
  size_t camera_index() const;
  std::vector<Shot> random_shots(size_t count);
  std::vector<Shot> shots_of_file(size_t count) const;

  const DatasetRequest& request_;
  const Scenario scenario_;
  FlightEnvironment environment_;
  Cameras cameras_;
  size_t camera_;
};

}  // namespace hedgehop::sim
