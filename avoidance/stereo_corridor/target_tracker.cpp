#include "avoidance/stereo_corridor/target_tracker.h"

#include <opencv2/video/tracking.hpp>

namespace hedgehop::avoidance::stereo_corridor {

std::optional<cv::Point> TargetTracker::follow(const std::optional<cv::Point>& pixel, const cv::Mat& grey) {
  std::optional<cv::Point> found;
  if (pixel && last_.size() == grey.size()) {
    const std::vector<cv::Point2f> before = {cv::Point2f(*pixel)};
    std::vector<cv::Point2f> after;
    std::vector<uint8_t> tracked;
    cv::calcOpticalFlowPyrLK(last_, grey, before, after, tracked, cv::noArray());
    const cv::Point place(after.front());
    if (tracked.front() && cv::Rect({}, grey.size()).contains(place)) found = place;
  }
  grey.copyTo(last_);
  return found;
}

}  // namespace hedgehop::avoidance::stereo_corridor
