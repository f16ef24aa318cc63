#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::vision::sections {

/// Overlapping sections of an image: rows x cols rectangles of equal size, evenly spaced up to the image's borders,
/// numbered from 0 at the top left, row by row. Source: [Perez2018] sec. V-B.
struct SectionGrid {
  int rows = 17, cols = 17;          ///< at least 1
  double width_share = 628. / 1280;  ///< of the image's width, in (0, 1]
  double height_share = 252. / 720;  ///< of the image's height, in (0, 1]
  int grow_px = 0;                   ///< dilation of threats, >= 0; not in the paper

  bool operator==(const SectionGrid&) const = default;
};

/// Returns the sections of an image in order. Throws std::invalid_argument if the grid or the size is out of range.
std::vector<cv::Rect> sections(const SectionGrid& grid, cv::Size image);

/// Treatment of pixels without depth.
enum class UnknownDepth { free, threat };

/// One choice among sections.
struct SectionChoice {
  int section = -1;    ///< the chosen section; -1 if even the best has too many threats
  int best = -1;       ///< the section with the minimum number of threats
  double share = 0.0;  ///< share of threats among the pixels of the best section
};

/// Chooses the section with the minimum share of threat pixels. An integral image makes the cost independent of the
/// number and size of sections. Reuses its memory. Differs: the paper counts every section pixel by pixel, at a cost
/// that increases with the number of sections (table 1).
class SectionSearch {
 public:
  /// Throws like sections().
  SectionSearch(const SectionGrid& grid, cv::Size image);

  /// Returns the section with the minimum share of threats; for equal shares the one closest to the image's center,
  /// then the one with the lower number.
  /// @param depth_m      CV_32F of the given size, m; NaN: unknown, +infinity: sky.
  /// @param threshold_m  pixels closer than this are threats, > 0.
  /// @param max_share    maximum share of threats in a chosen section, in [0, 1].
  /// @param open         returns whether a section may be chosen, called as rarely as possible; by default all are
  /// open. If
  ///                     every open section has too many threats, all sections count as open.
  SectionChoice choose(const cv::Mat& depth_m, double threshold_m, double max_share, UnknownDepth unknown,
                       const std::function<bool(int)>& open = {});

  const std::vector<cv::Rect>& sections() const { return sections_; }
  /// Returns the section straight ahead, which is chosen if all are equal.
  int center() const { return center_; }
  /// Returns the section whose center is closest to a point inside or outside the image.
  int nearest(const cv::Point2d& pixel) const;
  /// Returns the number of threats per section at the last choice.
  const std::vector<int>& threats() const { return threats_; }
  /// Returns the share of threats among a section's pixels at the last choice.
  double share(int section) const;

 private:
  cv::Size image_;
  int grow_px_ = 0;
  std::vector<cv::Rect> sections_;
  std::vector<double> off_center2_px2_;
  std::vector<int> threats_;
  int center_ = 0;
  cv::Mat mask_, sums_;
};

}  // namespace hedgehop::vision::sections
