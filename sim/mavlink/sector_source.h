#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "avoidance/module.h"
#include "avoidance/stereo/disparity_source.h"
#include "sim/mavlink/companion_config.h"
#include "sim/mavlink/obstacle_sectors.h"

namespace hedgehop::sim::mavlink {

/// Sectors from one depth camera or one stereo pair. Stereo images are reduced to a width of about kStereoWidthPx: a
/// sector is 5 deg wide, and the module matches the full images once more.
class SectorSource {
 public:
  static constexpr int64_t kPeriodNs = 100'000'000;  ///< between two images that are used
  static constexpr int kStereoWidthPx = 640;

  /// Of a depth camera.
  SectorSource(const avoidance::MountedCamera& depth, const SectorLimits& limits);
  /// Of the pair `left` and its right neighbor. @param pair  prefix of the roles, as in DisparitySource.
  SectorSource(const std::string& pair, const avoidance::MountedCamera& left, const avoidance::MountedCamera& right,
               const vision::stereo::StereoMatcherConfig& config, const SectorLimits& limits);

  /// Uses the new images of an observation, if there are any and the last ones are kPeriodNs old.
  void update(int64_t t_ns, const avoidance::Observation& observation);
  /// Returns the sectors of the last image; null if there is none in the last half second.
  const ObstacleSectors* sectors(int64_t t_ns) const;

 private:
  const cv::Mat* depth_of_pair(const avoidance::Observation& observation);

  std::string role_, right_role_;  ///< of the depth or left camera, and of the right one
  int reduction_ = 1;
  std::optional<avoidance::stereo::DisparitySource> stereo_;
  DepthToSectors to_sectors_;
  cv::Mat depth_m_;
  ObstacleSectors sectors_;
  std::optional<int64_t> seen_ns_;
};

/// Returns the sources that a module's cameras permit: each depth camera, and each parallel pair "left" and "right",
/// with or without a common prefix ("aft_left" and "aft_right").
std::vector<SectorSource> sector_sources(const PerceptionConfig& config, const avoidance::Needs& needs,
                                         const avoidance::Setup& setup, const SectorLimits& limits);

}  // namespace hedgehop::sim::mavlink
