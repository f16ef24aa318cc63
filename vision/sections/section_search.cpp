#include "vision/sections/section_search.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <tuple>

#include "sim/fields/invalid_field.h"

namespace hedgehop::vision::sections {
namespace {

/// Returns the first pixel of the k-th of `count` sections of `length` pixels within `whole`.
int first_pixel(int k, int count, int length, int whole) {
  return count == 1 ? (whole - length) / 2 : static_cast<int>(std::lround(k * double(whole - length) / (count - 1)));
}

}  // namespace

std::vector<cv::Rect> sections(const SectionGrid& grid, cv::Size image) {
  const auto need = [](bool holds, const char* key, const std::string& message) {
    if (!holds) throw fields::InvalidField(key, message);
  };
  need(grid.rows >= 1 && grid.cols >= 1, "sections", "a grid of sections needs at least one row and one column");
  need(grid.width_share > 0.0 && grid.width_share <= 1.0 && grid.height_share > 0.0 && grid.height_share <= 1.0,
       "sections", "the width and height of a section are shares of the image's, in (0, 1]");
  need(grid.grow_px >= 0, "grow", "the dilation of threats must be at least 0 px");
  const int width = static_cast<int>(std::lround(grid.width_share * image.width));
  const int height = static_cast<int>(std::lround(grid.height_share * image.height));
  need(width >= 1 && height >= 1, "sections",
       "an image of " + std::to_string(image.width) + " x " + std::to_string(image.height) +
           " px is too small: a section must have at least one pixel");
  std::vector<cv::Rect> found;
  for (int row = 0; row < grid.rows; ++row) {
    for (int col = 0; col < grid.cols; ++col) {
      found.emplace_back(first_pixel(col, grid.cols, width, image.width),
                         first_pixel(row, grid.rows, height, image.height), width, height);
    }
  }
  return found;
}

SectionSearch::SectionSearch(const SectionGrid& grid, cv::Size image)
    : image_(image), grow_px_(grid.grow_px), sections_(sections::sections(grid, image)), threats_(sections_.size()) {
  for (const cv::Rect& section : sections_) {
    const double du = section.x + 0.5 * section.width - 0.5 * image.width;
    const double dv = section.y + 0.5 * section.height - 0.5 * image.height;
    off_center2_px2_.push_back(du * du + dv * dv);
  }
  center_ = nearest({0.5 * image.width, 0.5 * image.height});
}

int SectionSearch::nearest(const cv::Point2d& pixel) const {
  const auto off2_px2 = [&](const cv::Rect& s) {
    const double du = s.x + 0.5 * s.width - pixel.x, dv = s.y + 0.5 * s.height - pixel.y;
    return du * du + dv * dv;
  };
  return static_cast<int>(std::ranges::min_element(sections_, {}, off2_px2) - sections_.begin());
}

double SectionSearch::share(int section) const {
  const auto i = static_cast<size_t>(section);
  return static_cast<double>(threats_[i]) / sections_[i].area();
}

SectionChoice SectionSearch::choose(const cv::Mat& depth_m, double threshold_m, double max_share, UnknownDepth unknown,
                                    const std::function<bool(int)>& open) {
  if (depth_m.size() != image_ || depth_m.type() != CV_32FC1) {
    throw std::invalid_argument("a depth image does not have the size or type that its sections were made for");
  }
  // Comparisons are false for NaN.
  if (unknown == UnknownDepth::free) {
    cv::compare(depth_m, threshold_m, mask_, cv::CMP_LT);
  } else {
    cv::compare(depth_m, threshold_m, mask_, cv::CMP_GE);
    cv::bitwise_not(mask_, mask_);
  }
  if (grow_px_ > 0) cv::dilate(mask_, mask_, cv::Mat(2 * grow_px_ + 1, 2 * grow_px_ + 1, CV_8U, cv::Scalar(1)));
  cv::integral(mask_, sums_, CV_32S);

  const auto rank = [&](int i) {
    return std::tuple(threats_[static_cast<size_t>(i)], off_center2_px2_[static_cast<size_t>(i)]);
  };
  SectionChoice choice;
  for (size_t i = 0; i < sections_.size(); ++i) {
    const cv::Rect& s = sections_[i];
    const int corners = sums_.at<int>(s.y, s.x) + sums_.at<int>(s.br()) - sums_.at<int>(s.y, s.x + s.width) -
                        sums_.at<int>(s.y + s.height, s.x);
    constexpr int kSet = 255;  // of the mask
    threats_[i] = corners / kSet;
    const int section = static_cast<int>(i);
    if (choice.best < 0 || rank(section) < rank(choice.best)) choice.best = section;
  }
  if (open) {
    int best_open = -1;
    for (int i = 0; i < static_cast<int>(sections_.size()); ++i) {
      const bool better = share(i) <= max_share && (best_open < 0 || rank(i) < rank(best_open));
      if (better && open(i)) best_open = i;
    }
    if (best_open >= 0) choice.best = best_open;
  }
  choice.share = share(choice.best);
  if (choice.share <= max_share) choice.section = choice.best;
  return choice;
}

}  // namespace hedgehop::vision::sections
