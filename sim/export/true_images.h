#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "sim/flight/flight_watcher.h"

namespace hedgehop::sim {

/// Writes ground-truth images of a data set to `truth/cam0..`: `depth/` (16 bit, mm; 0: unknown or more than 65.5 m),
/// `labels/` (16 bit, as ImageChannel::labels), `moving/` (255 on moving obstacles) and `flow/` (to the next image of
/// the camera; 16 bit, red 64 u + 32768, green 64 v + 32768, blue 1 if known, as in KITTI [MenzeGeiger2015] sec. 4). A
/// file has the name of its image. The last image has no flow.
class TrueImages {
 public:
  /// @param out  folder of the data set.
  explicit TrueImages(std::filesystem::path out) : out_(std::move(out)) {}

  /// @param camera  number of the camera. @param stem  of the file of the image. Throws std::runtime_error for a file
  /// that cannot be written, and for more than 65,535 labels.
  void write(size_t camera, const std::string& role, const SensorTick& tick, const std::string& stem);

 private:
  std::filesystem::path out_;
  std::map<size_t, std::string> last_stem_;  ///< of each camera
};

}  // namespace hedgehop::sim
