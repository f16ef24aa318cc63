#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::vision::sections {

/// Overlapping sections of an image: rows x cols rectangles of one size, spread evenly so that the outermost reach the
/// image's edges, numbered from the top left, row by row, from 0. Source: [Perez2018] sec. V-B.
struct SectionGrid {
  int rows = 17, cols = 17;          ///< at least 1
  double width_share = 628. / 1280;  ///< of the image's width, in (0, 1]
  double height_share = 252. / 720;  ///< of the image's height, in (0, 1]
  int grow_px = 0;                   ///< by which threats are dilated, >= 0; beyond the paper

  bool operator==(const SectionGrid&) const = default;
};

/// Sections of an image, in their order. Throws std::invalid_argument on a grid or size out of range.
std::vector<cv::Rect> sections(const SectionGrid& grid, cv::Size image);

/// What a pixel without depth counts as.
enum class UnknownDepth { free, threat };

/// One choice among sections.
struct SectionChoice {
  int section = -1;    ///< the chosen one; -1 when even the best holds too many threats
  int best = -1;       ///< the one with the least threats
  double share = 0.0;  ///< of the best one's pixels that are threats
};

/// Chooses the section with the smallest share of pixels that are threats. Sums come from an integral image, so that
/// the cost does not depend on the number and size of sections. Reuses its memory from image to image. Differs: the
/// paper counts every section pixel by pixel, and its cost grows with their number (table 1).
class SectionSearch {
 public:
  /// Throws as sections().
  SectionSearch(const SectionGrid& grid, cv::Size image);

  /// @param depth_m      rows x cols, CV_32F, of the size given, m; NaN unknown, +infinity sky.
  /// @param threshold_m  what is nearer is a threat, > 0.
  /// @param most_share   share of threats above which a section is not chosen, in [0, 1].
  /// @param open         whether a section may be chosen, called as seldom as possible; empty: all may. Where no
  ///                     open section has few enough threats, all count as open.
  /// @return equal shares go to the section whose center lies nearest the image's center, then to the lower number.
  SectionChoice choose(const cv::Mat& depth_m, double threshold_m, double most_share, UnknownDepth unknown,
                       const std::function<bool(int)>& open = {});

  const std::vector<cv::Rect>& sections() const { return sections_; }
  /// The section straight ahead: the one that wins when all are alike.
  int center() const { return center_; }
  /// The section whose center lies nearest to a place of the image or beyond its edges.
  int nearest(const cv::Point2d& pixel) const;
  /// Threats per section at the last choice.
  const std::vector<int>& threats() const { return threats_; }
  /// Share of a section's pixels that were threats at the last choice.
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
