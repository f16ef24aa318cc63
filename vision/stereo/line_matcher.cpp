#include "vision/stereo/line_matcher.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>

#include "vision/flow/wide_integers.h"

namespace hedgehop::vision::stereo {
namespace {

constexpr int kSidePx = 3;            // distance of the pixels compared with a point: lines of up to 5 px along the row
constexpr int kPeakPx = 2;            // distance within which a point has the largest contrast
constexpr int kMinLineContrast = 12;  // grey levels: six sigma of the noise of a camera in daylight
constexpr int kMinLinePx = 3;         // disparity; a pair of 350 px and 0.25 m cannot place lines beyond 29 m
constexpr int kReach = 2;             // cells by which a line may be farther aside in the next row of cells
constexpr int kPadding = 8;           // bytes read at a time

/// Computes by how much each pixel is darker, or brighter, than both pixels at a distance of kSidePx in its row.
HEDGEHOP_WIDE void find_contrast(const uint8_t* grey, int width, uint8_t* dark, uint8_t* bright) {
  for (int u = kSidePx; u < width - kSidePx; ++u) {
    const uint8_t before = grey[u - kSidePx], after = grey[u + kSidePx], here = grey[u];
    const uint8_t low = before < after ? before : after, high = before < after ? after : before;
    dark[u] = low > here ? static_cast<uint8_t>(low - here) : uint8_t{0};
    bright[u] = here > high ? static_cast<uint8_t>(here - high) : uint8_t{0};
  }
}

/// Smooths with about 1 2 1, so that the middle of a line of several pixels has the largest value.
HEDGEHOP_WIDE void smooth_row(const uint8_t* contrast, int width, uint8_t* smooth) {
  for (int u = 1; u < width - 1; ++u) {
    const auto sides = static_cast<uint8_t>((contrast[u - 1] + contrast[u + 1] + 1) >> 1);
    smooth[u] = static_cast<uint8_t>((contrast[u] + sides + 1) >> 1);
  }
}

/// Keeps contrasts that are large and whose smoothed value is the largest nearby; of equal ones the first.
HEDGEHOP_WIDE void keep_peaks(const uint8_t* contrast, const uint8_t* smooth, int width, uint8_t* peaks) {
  static_assert(kPeakPx == 2);
  for (int u = kPeakPx; u < width - kPeakPx; ++u) {
    const uint8_t here = smooth[u];
    const bool peak = (contrast[u] >= kMinLineContrast) & (here > smooth[u - 1]) & (here > smooth[u - 2]) &
                      (here >= smooth[u + 1]) & (here >= smooth[u + 2]);
    peaks[u] = peak ? contrast[u] : uint8_t{0};
  }
}

/// The contrasts of points that may show the same line as a point. A line thinner than a pixel has half the contrast if
/// it is between two pixels.
struct SimilarContrast {
  explicit SimilarContrast(int contrast)
      : low(static_cast<uint8_t>(std::max(2 * contrast / 5, 1))),
        high(static_cast<uint8_t>(std::min(5 * contrast / 2, 255))) {}
  bool contains(uint8_t contrast) const { return (contrast >= low) & (contrast <= high); }
  uint8_t low, high;
};

using Counts = std::array<uint8_t, LineMatcher::kDisparities>;

/// Counts the bits of three cells together, at each disparity and the next one.
HEDGEHOP_WIDE void count_rows_of_cell(const Counts& here, const Counts& before, const Counts& after, Counts& counts) {
  Counts all;
  for (size_t d = 0; d < all.size(); ++d) all[d] = static_cast<uint8_t>(here[d] | before[d] | after[d]);
  counts.back() = 0;
  for (size_t d = 0; d + 1 < all.size(); ++d) {
    auto bits = static_cast<uint8_t>(all[d] | all[d + 1]);
    bits = static_cast<uint8_t>(bits - ((bits >> 1) & 0x55));
    bits = static_cast<uint8_t>((bits & 0x33) + ((bits >> 2) & 0x33));
    counts[d] = static_cast<uint8_t>((bits + (bits >> 4)) & 0x0F);
  }
}

HEDGEHOP_WIDE void find_maximum(const Counts& counts, Counts& most) {
  for (size_t d = 0; d < most.size(); ++d) most[d] = counts[d] > most[d] ? counts[d] : most[d];
}

HEDGEHOP_WIDE void find_maximum_of_adjacent(Counts& most) {
  std::array<uint8_t, LineMatcher::kDisparities + 2> padded{};
  std::memcpy(padded.data() + 1, most.data(), most.size());
  for (size_t d = 0; d < most.size(); ++d) {
    const uint8_t sides = padded[d] > padded[d + 2] ? padded[d] : padded[d + 2];
    most[d] = sides > most[d] ? sides : most[d];
  }
}

/// Sets a bit of each disparity at which a point has a counterpart.
HEDGEHOP_WIDE void add_matches(const uint8_t* contrasts, uint8_t low, uint8_t high, uint8_t bit, Counts& matched) {
  for (size_t d = 0; d < matched.size(); ++d) {
    const uint8_t here = (contrasts[d] >= low) & (contrasts[d] <= high) ? bit : uint8_t{0};
    matched[d] = static_cast<uint8_t>(matched[d] | here);
  }
}

}  // namespace

void LineMatcher::find_points(const uint8_t* grey, int width, std::vector<Point>& points) {
  find_contrast(grey, width, dark_.data(), bright_.data());
  smooth_row(dark_.data(), width, smooth_.data());
  keep_peaks(dark_.data(), smooth_.data(), width, dark_peaks_.data());
  smooth_row(bright_.data(), width, smooth_.data());
  keep_peaks(bright_.data(), smooth_.data(), width, bright_peaks_.data());
  points.clear();
  for (int begin = 0; begin < width; begin += kPadding) {
    uint64_t dark = 0, bright = 0;
    std::memcpy(&dark, dark_peaks_.data() + begin, sizeof dark);
    std::memcpy(&bright, bright_peaks_.data() + begin, sizeof bright);
    for (uint64_t either = dark | bright; either != 0;) {
      constexpr int kByte = 8;
      static_assert(std::endian::native == std::endian::little);
      const int i = std::countr_zero(either) / kByte;
      either &= ~(uint64_t{0xFF} << (kByte * i));
      const auto bright_here = static_cast<uint8_t>(bright >> (kByte * i));
      const auto dark_here = static_cast<uint8_t>(dark >> (kByte * i));
      points.push_back({begin + i, std::max(dark_here, bright_here), bright_here != 0});
    }
  }
}

/// Returns whether a point has a counterpart at the disparity of a surface, and marks it.
bool LineMatcher::is_of_surface(const Point& point, int surface16, int width) {
  constexpr int kWithin = 1;  // px, for the rounding of both points
  const int at = point.u - (surface16 + static_cast<int>(kDisparityUnits) / 2) / static_cast<int>(kDisparityUnits);
  const std::vector<uint8_t>& contrasts = point.bright ? bright_peaks_ : dark_peaks_;
  const SimilarContrast similar(point.contrast);
  bool found = false;
  for (int x = std::max(at - kWithin, 0); x <= std::min(at + kWithin, width - 1); ++x) {
    if (!similar.contains(contrasts[static_cast<size_t>(x)])) continue;
    of_surface_[static_cast<size_t>(x)] = 1;
    found = true;
  }
  return found;
}

/// Matches the points of row v of the images, found before; those of the right image last.
void LineMatcher::match_row(const int16_t* disparity16, int width, int v) {
  constexpr int kAsidePx = 6;  // beyond half of the matcher's window, where the line does not disturb its matches
  std::ranges::fill(of_surface_, uint8_t{0});
  const auto at_known_surface = std::ranges::partition(left_, [&](const Point& point) {
    return std::max({disparity16[std::max(point.u - kAsidePx, 0)], disparity16[point.u],
                     disparity16[std::min(point.u + kAsidePx, width - 1)]}) < 0;
  });
  const size_t unknown = left_.size() - at_known_surface.size();
  size_t remaining = unknown;
  for (const Point& point : at_known_surface) {
    bool known = false;
    int before16 = kNoDisparity;
    for (const int u : {point.u, std::max(point.u - kAsidePx, 0), std::min(point.u + kAsidePx, width - 1)}) {
      if (disparity16[u] < 0 || disparity16[u] == before16) continue;
      before16 = disparity16[u];
      known = is_of_surface(point, before16, width);
      if (known) break;
    }
    if (!known) left_[remaining++] = point;
  }
  left_.resize(remaining);
  // From right to left, so that the contrasts at increasing disparities follow each other.
  for (auto* contrasts : {&dark_leftward_, &bright_leftward_}) std::ranges::fill(*contrasts, uint8_t{0});
  const auto leftward = [&](const Point& point) -> uint8_t& {
    return (point.bright ? bright_leftward_ : dark_leftward_)[static_cast<size_t>(width - 1 - point.u)];
  };
  for (const Point& point : right_) leftward(point) = point.contrast;
  for (size_t i = 0; i < left_.size(); ++i) {
    // Points of a surface are no counterparts of a line in front of it. If the surface is not known, any may be.
    if (i == unknown) {
      for (const Point& point : right_) {
        if (of_surface_[static_cast<size_t>(point.u)] != 0) leftward(point) = 0;
      }
    }
    const Point& point = left_[i];
    const SimilarContrast similar(point.contrast);
    const std::vector<uint8_t>& contrasts = point.bright ? bright_leftward_ : dark_leftward_;
    add_matches(contrasts.data() + width - 1 - point.u, similar.low, similar.high,
                static_cast<uint8_t>(1U << (v % kCellPx)), matched_[index(v / kCellPx, point.u / kCellPx)]);
  }
}

/// Counts the rows of each cell that have a match at a disparity or the next one, in the cell or next to it.
/// @param rows  of cells.
void LineMatcher::count_rows(const cv::Range& rows) {
  for (int row = rows.start; row < rows.end; ++row) {
    for (int col = 0; col < cols_; ++col) {
      const Cell& before = matched_[index(row, std::max(col - 1, 0))];
      const Cell& after = matched_[index(row, std::min(col + 1, cols_ - 1))];
      count_rows_of_cell(matched_[index(row, col)], before, after, supported_[index(row, col)]);
    }
  }
  // Of the cells within kReach aside, at adjacent disparities, too.
  for (int row = rows.start; row < rows.end; ++row) {
    for (int col = 0; col < cols_; ++col) {
      Cell& most = continued_[index(row, col)];
      most.fill(0);
      for (int aside = std::max(col - kReach, 0); aside <= std::min(col + kReach, cols_ - 1); ++aside) {
        find_maximum(supported_[index(row, aside)], most);
      }
      find_maximum_of_adjacent(most);
    }
  }
}

/// Returns the disparity x 16 of the line in a cell; kNoDisparity without one.
int LineMatcher::line16(int row, int col) const {
  constexpr int kMinRows = 12;     // of the 24 rows of a cell and those above and below
  constexpr int kMinCellRows = 4;  // of the eight rows of the cell; a line at 18 degrees crosses three cells in them
  constexpr int kMinOwnRows = 2;   // in the cell itself
  constexpr int kAmbiguous = 4;    // minimum difference to the rows of another disparity
  constexpr int kSamePx = 2;       // difference of disparities of one line
  const Cell& supported = supported_[index(row, col)];
  if (*std::ranges::max_element(supported) < kMinCellRows) return kNoDisparity;
  constexpr Cell kNone{};
  const Cell& above = row > 0 ? continued_[index(row - 1, col)] : kNone;
  const Cell& below = row + 1 < rows_ ? continued_[index(row + 1, col)] : kNone;
  Cell rows;
  for (size_t d = 0; d < kDisparities; ++d) rows[d] = static_cast<uint8_t>(supported[d] + above[d] + below[d]);
  const auto best = std::ranges::max_element(rows);
  const auto d = static_cast<int>(best - rows.begin());
  if (*best < kMinRows || d < kMinLinePx || supported[static_cast<size_t>(d)] < kMinCellRows) return kNoDisparity;
  for (int other = 0; other < kDisparities; ++other) {
    if (std::abs(other - d) > kSamePx && rows[static_cast<size_t>(other)] + kAmbiguous > *best) return kNoDisparity;
  }
  const auto matched_at = [&](int column, int disparity) {
    return std::popcount(matched_[index(row, column)][static_cast<size_t>(disparity)]);
  };
  if (matched_at(col, d) + matched_at(col, d + 1) < kMinOwnRows) return kNoDisparity;
  int at_d = 0, at_next = 0;
  for (int aside = std::max(col - 1, 0); aside <= std::min(col + 1, cols_ - 1); ++aside) {
    at_d += matched_at(aside, d);
    at_next += matched_at(aside, d + 1);
  }
  const auto units = static_cast<int>(kDisparityUnits);
  return units * d + units * at_next / (at_d + at_next);
}

void LineMatcher::match(const cv::Mat& left, const cv::Mat& right, const cv::Mat& disparity16, const cv::Range& rows,
                        cv::Mat& lines16) {
  const int width = left.cols;
  rows_ = left.rows / kCellPx;
  cols_ = width / kCellPx;
  lines16.create(rows_, cols_, CV_16SC1);
  lines16.setTo(kNoDisparity);
  if (rows_ == 0 || cols_ == 0) return;
  for (auto* row : {&dark_, &bright_, &smooth_, &dark_peaks_, &bright_peaks_}) {
    row->assign(static_cast<size_t>(width + kPadding), uint8_t{0});
  }
  for (auto* row : {&dark_leftward_, &bright_leftward_}) row->resize(static_cast<size_t>(width + kDisparities));
  of_surface_.resize(static_cast<size_t>(width));
  // Pixels right of the last complete cell count as part of a cell that is not evaluated.
  matched_.assign(index(rows_, 0) + 1, Cell{});
  supported_.assign(matched_.size(), Cell{});
  continued_.assign(matched_.size(), Cell{});
  for (int v = std::max(rows.start, 0); v < std::min(rows.end, rows_ * kCellPx); ++v) {
    find_points(left.ptr<uint8_t>(v), cols_ * kCellPx, left_);
    if (left_.empty()) continue;
    find_points(right.ptr<uint8_t>(v), width, right_);
    if (!right_.empty()) match_row(disparity16.ptr<int16_t>(v), width, v);
  }
  const cv::Range cell_rows(std::max(rows.start, 0) / kCellPx, std::min(rows.end / kCellPx + 1, rows_));
  count_rows(cell_rows);
  for (int row = cell_rows.start; row < cell_rows.end; ++row) {
    for (int col = 0; col < cols_; ++col) lines16.at<int16_t>(row, col) = static_cast<int16_t>(line16(row, col));
  }
}

}  // namespace hedgehop::vision::stereo
