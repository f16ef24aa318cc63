#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "sim/flight/flight_watcher.h"

namespace hedgehop::sim {

/// Beside a data set's images, in `truth/cam0..`, what a pixel shows: `depth/` (16 bit, mm, 0 unknown or beyond 65.5
/// m), `labels/` (16 bit, as ImageChannel::labels), `moving/` (255 on what moves) and `flow/` (to the camera's next
/// image; 16 bit, red 64 u + 32768, green 64 v + 32768, blue 1 where known, as KITTI's [MenzeGeiger2015] sec. 4). A
/// file has its image's name; the last image has no flow.
class TrueImages {
 public:
  /// @param out  folder of the data set.
  explicit TrueImages(std::filesystem::path out) : out_(std::move(out)) {}

  /// @param camera  its number. @param stem  of the image's file. Throws std::runtime_error for a file that cannot be
  /// written, and for more than 65,535 labels.
  void write(size_t camera, const std::string& role, const SensorTick& tick, const std::string& stem);

 private:
  std::filesystem::path out_;
  std::map<size_t, std::string> last_stem_;  ///< of each camera
};

}  // namespace hedgehop::sim
