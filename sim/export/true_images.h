#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "sim/flight/flight_watcher.h"

namespace hedgehop::sim {

/// Returns optic flow in KITTI's encoding, CV_16UC3, RGB: red 64 u + 32768, green 64 v + 32768, blue 1 if known
/// [MenzeGeiger2015] sec. 4. @param flow_px  CV_32FC2.
cv::Mat kitti_flow(const cv::Mat& flow_px);

/// An image of a data set. `name` is relative to the folder of the set.
struct ImageFile {
  std::filesystem::path name;
  cv::Mat image;
};

/// Files of true depth.
enum class DepthFormat {
  png_mm,   ///< 16 bit, mm; 0: unknown, sky, or more than 65.5 m
  float_m,  ///< TIFF of 32-bit floats, m; infinity: sky, NaN: unknown
};

/// The ground-truth images of a data set, in `truth/cam0..`: `depth/`, `labels/` and `semantic/` (16 bit, as
/// ImageChannel), `moving/` (255 on moving obstacles) and `flow/` (to the next image of the camera; 16 bit, red
/// 64 u + 32768, green 64 v + 32768, blue 1 if known, as in KITTI [MenzeGeiger2015] sec. 4). A file has the name of its
/// image. The next image is the next one of the data set. The last image has no flow.
class TrueImages {
 public:
  explicit TrueImages(DepthFormat depth) : depth_(depth) {}

  /// Returns the ground truth of an image, and the flow of the camera's image before. @param camera  number of the
  /// camera.
  /// @param stem  of the file of the image. Throws std::runtime_error for more than 65,535 labels.
  std::vector<ImageFile> images(size_t camera, const std::string& role, const SensorTick& tick,
                                const std::string& stem);

 private:
  DepthFormat depth_;
  std::map<size_t, std::string> last_stem_;  ///< of each camera
};

}  // namespace hedgehop::sim
