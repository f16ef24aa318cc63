#include "vision/flow/reduced_image.h"

#include <algorithm>
#include <opencv2/core/hal/intrin.hpp>
#include <stdexcept>

#include "vision/flow/wide_integers.h"

namespace hedgehop::vision::flow {
namespace {

constexpr int kLeftRoom = 8, kRightRoom = 16;
constexpr size_t kPastEnd = 16;  // values that may be read past the end of the rim

// Repeats the first and last value of a row in the spare values next to it.
void repeat_ends(int16_t* line, int width) {
  line[-1] = line[0];
  std::fill(line + width, line + width + kRightRoom, line[width - 1]);
}

// Vertically weighted sums. Rows of the full image have 8 bits, those of reduced images 16.
HEDGEHOP_WIDE void weigh_three(const uint8_t* a, const uint8_t* b, const uint8_t* c, int width, int16_t* line) {
  for (int x = 0; x < width; ++x) line[x] = static_cast<int16_t>(a[x] + 2 * b[x] + c[x]);
}
HEDGEHOP_WIDE void weigh_three(const int16_t* a, const int16_t* b, const int16_t* c, int width, int16_t* line) {
  for (int x = 0; x < width; ++x) line[x] = static_cast<int16_t>(a[x] + 2 * b[x] + c[x]);
}
HEDGEHOP_WIDE void weigh_four(const uint8_t* a, const uint8_t* b, const uint8_t* c, const uint8_t* d, int width,
                              int16_t* line) {
  for (int x = 0; x < width; ++x) line[x] = static_cast<int16_t>(a[x] + 3 * (b[x] + c[x]) + d[x]);
}
HEDGEHOP_WIDE void weigh_four(const int16_t* a, const int16_t* b, const int16_t* c, const int16_t* d, int width,
                              int16_t* line) {
  for (int x = 0; x < width; ++x) line[x] = static_cast<int16_t>(a[x] + 3 * (b[x] + c[x]) + d[x]);
}

HEDGEHOP_WIDE void smooth_line(const int16_t* line, int width, int shift, int16_t* to) {
  const int half = shift > 0 ? 1 << (shift - 1) : 0;
  for (int x = 0; x < width; ++x) {
    // The sum requires 16 unsigned bits.
    const auto sum = static_cast<uint16_t>(line[x - 1] + 2 * line[x] + line[x + 1] + half);
    to[x] = static_cast<int16_t>(static_cast<uint16_t>(sum >> shift));
  }
}

}  // namespace

ReducedImage::ReducedImage(int width, int height, int rim_px)
    : width_(width),
      height_(height),
      rim_rows_(rim_px + 1),
      rim_cols_(padded(rim_px + 1)),
      stride_(padded(width) + 2 * padded(rim_px + 1)),
      data_(static_cast<size_t>(stride_) * static_cast<size_t>(height + 2 * (rim_px + 1)) + kPastEnd, int16_t{0}) {}

ImageReducer::ImageReducer(int max_width, int bits)
    : bits_(bits), line_(static_cast<size_t>(kLeftRoom + padded(max_width) + kRightRoom), int16_t{0}) {
  if (bits < 8 || bits > 12) throw std::invalid_argument("reduced images hold 8 to 12 bits");
}

void ImageReducer::smooth(const cv::Mat& grey, ReducedImage& out) {
  smooth_rows([&](int y) { return grey.ptr<uint8_t>(y); }, grey.cols, grey.rows, 12 - bits_, out);
}
void ImageReducer::smooth(const ReducedImage& in, ReducedImage& out) {
  smooth_rows([&](int y) { return in.row(y); }, in.width(), in.height(), 4, out);
}
void ImageReducer::halve(const cv::Mat& grey, ReducedImage& out) {
  halve_rows([&](int y) { return grey.ptr<uint8_t>(y); }, grey.cols, grey.rows, 14 - bits_, out);
}
void ImageReducer::halve(const ReducedImage& in, ReducedImage& out) {
  halve_rows([&](int y) { return in.row(y); }, in.width(), in.height(), 6, out);
}

template <class Row>
void ImageReducer::smooth_rows(Row row, int width, int height, int shift, ReducedImage& out) {
  int16_t* line = line_.data() + kLeftRoom;
  for (int y = 0; y < height; ++y) {
    const auto* a = row(std::max(y - 1, 0));
    const auto* b = row(y);
    const auto* c = row(std::min(y + 1, height - 1));
    weigh_three(a, b, c, width, line);
    repeat_ends(line, width);
    smooth_line(line, width, shift, out.row(y));
  }
}

template <class Row>
void ImageReducer::halve_rows(Row row, int width, int height, int shift, ReducedImage& out) {
  int16_t* line = line_.data() + kLeftRoom;
  const auto left = cv::v_int16x8(1, 3, 1, 3, 1, 3, 1, 3), right = cv::v_int16x8(3, 1, 3, 1, 3, 1, 3, 1);
  const auto half = cv::v_setall_s32(shift > 0 ? 1 << (shift - 1) : 0);
  for (int y = 0; y < out.height(); ++y) {
    const auto* a = row(std::max(2 * y - 1, 0));
    const auto* b = row(2 * y);
    const auto* c = row(std::min(2 * y + 1, height - 1));
    const auto* d = row(std::min(2 * y + 2, height - 1));
    weigh_four(a, b, c, d, width, line);
    repeat_ends(line, width);
    // Four results at a time: neighbors 2i - 1 and 2i with weights 1 and 3, then 2i + 1 and 2i + 2 with 3 and 1.
    int16_t* to = out.row(y);
    for (int i = 0; i < out.width(); i += 4) {
      const int16_t* from = line + 2 * i;
      const auto sum = cv::v_dotprod(cv::v_load(from - 1), left) + cv::v_dotprod(cv::v_load(from + 1), right) + half;
      cv::v_pack_store(to + i, sum >> shift);
    }
    // Restore the zeros of the rim beyond the last column.
    std::fill(to + out.width(), to + padded(out.width()), int16_t{0});
  }
}

}  // namespace hedgehop::vision::flow
