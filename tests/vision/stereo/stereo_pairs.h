#pragma once

#include <opencv2/imgproc.hpp>
#include <ostream>
#include <string>
#include <vector>

namespace hedgehop::vision::stereo {

/// Parameters of a comparison with one of OpenCV's matchers.
struct Task {
  int disparities_px, block_px;
  cv::Size image;
  friend std::ostream& operator<<(std::ostream& out, const Task& task) {
    return out << task.disparities_px << "_" << task.block_px << "_" << task.image.width << "x" << task.image.height;
  }
};

struct StereoPair {
  std::string what;
  cv::Mat left, right;
};

inline cv::Mat random_image(uint64_t seed, cv::Size size, int levels) {
  cv::Mat image(size, CV_8UC1);
  cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 0, levels);
  return image * (255 / (levels - 1));
}

inline cv::Mat smooth_image(uint64_t seed, cv::Size size) {
  cv::Mat image = random_image(seed, size, 256);
  cv::GaussianBlur(image, image, {}, 1.2);
  return 4 * (image - 96);
}

/// Returns pairs that can be matched, pairs that cannot, and pairs of extreme costs.
inline std::vector<StereoPair> stereo_pairs(cv::Size size) {
  const cv::Mat left = smooth_image(1, size), plain(size, CV_8UC1, cv::Scalar(90));
  cv::Mat shifted, half_plain = left.clone();
  const cv::Mat slanted = (cv::Mat_<double>(2, 3) << 1.02, 0.05, -6.3, 0.0, 1.0, 0.0);
  cv::warpAffine(left, shifted, slanted, size, cv::INTER_CUBIC, cv::BORDER_REFLECT);
  half_plain.colRange(0, size.width / 2).setTo(90);
  return {{"a slanted wall", left, shifted},
          {"another image", left, smooth_image(2, size)},
          {"a wall with little texture", half_plain, shifted},
          // Maximum costs: sums saturate.
          {"black and white", random_image(3, size, 2), random_image(4, size, 2)},
          {"black", random_image(5, size, 2), cv::Mat(size, CV_8UC1, cv::Scalar(0))},
          // Zero costs, many of them equal.
          {"plain", plain, plain}};
}

/// Returns an image with a margin on the left, for which OpenCV computes no disparities.
inline cv::Mat with_margin(const cv::Mat& image, int margin_px) {
  cv::Mat wide;
  cv::copyMakeBorder(image, wide, 0, 0, margin_px, 0, cv::BORDER_REPLICATE);
  return wide;
}

}  // namespace hedgehop::vision::stereo
