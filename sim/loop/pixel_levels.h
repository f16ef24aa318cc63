#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

// Arithmetic on the grey levels of a sensor's pixels, in one pass over the image. All results have the bits of the
// single steps, each rounded to float, on every processor.
namespace hedgehop::sim {

/// Fills an image with independent standard normal numbers; equal seeds give equal images. Each comes from 16 bits of
/// SplitMix64's output at a place of its own: one of 65,536 equally likely numbers, the quantiles of the middles of as
/// many equal shares [Wichura1988] p. 483, scaled to a variance of 1. All are within 4.4; the normal
/// distribution has one in 90,000 beyond.
/// @param image  CV_32F, of any size and number of channels.
void fill_normal(uint64_t seed, cv::Mat& image);

/// Noise of an image: normal, with a variance of variance_per_level * level + read_variance, levels squared.
struct LevelNoise {
  uint64_t seed = 0;  ///< of fill_normal()
  double variance_per_level = 0.0;
  double read_variance = 0.0;
};

/// Multiplies each level by the response of its pixel and by the gain, adds the noise, and rounds to 0..255. With
/// noise, levels saturate at 255 before it is added.
/// @param response  CV_32F, of the size and channels of the image; empty: 1 everywhere.
/// @param image  CV_8U, of any number of channels.
void read_out(const cv::Mat& response, double gain, const std::optional<LevelNoise>& noise, cv::Mat& image);

/// Adds the levels of an image to sums.
/// @param image  CV_8U. @param sums  CV_16U, of the size and channels of the image.
void add_levels(const cv::Mat& image, cv::Mat& sums);

/// Writes the rounded means of images: of the sums of all but the last, and the last.
/// @param count  number of images, 2..257. @param out  CV_8U, of the size and channels of the others; may be `last`.
void mean_levels(const cv::Mat& sums, const cv::Mat& last, int count, cv::Mat& out);

}  // namespace hedgehop::sim
