#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace hedgehop::sim {

/// Fills an image with independent standard normal numbers; equal seeds give equal images. Each comes from 16 bits of
/// SplitMix64's output at a place of its own: one of 65,536 equally likely numbers, the quantiles of the middles of as
/// many equal shares [Wichura1988] p. 483, scaled to a variance of 1. None lies beyond 4.4, where the normal
/// distribution leaves one in 90,000.
/// @param image  CV_32F, of any size and number of channels.
void fill_normal(uint64_t seed, cv::Mat& image);

}  // namespace hedgehop::sim
