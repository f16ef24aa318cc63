#pragma once

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace hedgehop::sim {

/// The images and annotations of one world for a COCO file, after [LinEtAl2014]: one annotation for each instance in an
/// image, with bounding box, area and mask as uncompressed run lengths, column by column. Ground, roads and ceilings
/// are no instances there.
class CocoImages {
 public:
  explicit CocoImages(const scenes::Scene& scene) : instances_(scenes::instances(scene)) {}

  /// @param labels  CV_16UC1, as ImageChannel::labels.
  void add(size_t id, const std::string& file, const cv::Mat& labels);
  /// Returns {"images": [...], "annotations": [...]}.
  std::string json() const;

 private:
  std::vector<scenes::Instance> instances_;
  nlohmann::ordered_json images_ = nlohmann::ordered_json::array(), annotations_ = nlohmann::ordered_json::array();
};

/// Returns a COCO file with the images and annotations of worlds, numbered, and the categories.
std::string join_coco(const std::vector<std::string>& worlds);

}  // namespace hedgehop::sim
