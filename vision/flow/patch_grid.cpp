#include "vision/flow/patch_grid.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>
#include <stdexcept>
#include <string>

#include "vision/flow/wide_integers.h"

#ifdef HEDGEHOP_HAS_AVX2
#include <immintrin.h>
#endif

namespace hedgehop::vision::flow {

namespace {

// Computes in units of the alignment, so that rounding preserves the symmetry.
std::vector<PatchRange> make_ranges(int count, int patch_px, int margin_px, int unit_px, int length_px) {
  const int length = length_px / unit_px;
  const int patch = std::max(1, patch_px / unit_px);
  const int margin = (margin_px + unit_px - 1) / unit_px;
  const int room = length - patch - 2 * margin;
  if (count < 1 || room < 0) {
    throw std::invalid_argument("flow: patches of " + std::to_string(patch_px) + " px within a margin of " +
                                std::to_string(margin_px) + " px do not fit " + std::to_string(length_px) + " px");
  }
  std::vector<PatchRange> ranges;
  for (int i = 0; i < count; ++i) {
    const int mirrored = std::min(i, count - 1 - i);
    int begin = (length - patch) / 2;
    if (2 * i + 1 != count) begin = margin + static_cast<int>(std::lround(room * mirrored / (count - 1.0)));
    if (2 * i + 1 > count) begin = length - patch - begin;
    ranges.push_back({begin * unit_px, (begin + patch) * unit_px});
  }
  return ranges;
}

std::vector<PatchRange> reduce_ranges(const std::vector<PatchRange>& ranges, int reduction, int first_px, int unit,
                                      int length) {
  std::vector<PatchRange> reduced;
  for (const PatchRange& range : ranges) {
    const double scale = static_cast<double>(reduction) * unit;
    const int size = std::max(1, static_cast<int>(std::lround((range.end - range.begin) / scale)));
    const int begin = static_cast<int>(std::lround((range.begin - first_px) / scale));
    const int last = length / unit - size;
    const int kept = std::clamp(begin, 0, std::max(last, 0));
    reduced.push_back({kept * unit, (kept + size) * unit});
  }
  return reduced;
}

}  // namespace

PatchGrid make_patch_grid(int rows, int cols, int patch_px, int margin_px, int alignment_px, int width_px,
                          int height_px) {
  return {make_ranges(rows, patch_px, margin_px, alignment_px, height_px),
          make_ranges(cols, patch_px, margin_px, 2 * alignment_px, width_px)};
}

PatchGrid reduce_patch_grid(const PatchGrid& grid, int reduction, int first_row_px, int width_px, int height_px) {
  return {reduce_ranges(grid.rows, reduction, first_row_px, 1, height_px),
          reduce_ranges(grid.cols, reduction, 0, 2, width_px)};
}

namespace {

// Adds the products of pairs of numbers to their sums modulo 2^32, four or eight pairs at a time.
HEDGEHOP_TARGET_DEFAULT void add_products(const int16_t* a, const int16_t* b, int pairs, int32_t* sum) {
  for (int i = 0; i < pairs; i += 4) {
    cv::v_store(sum + i, cv::v_load(sum + i) + cv::v_dotprod(cv::v_load(a + 2 * i), cv::v_load(b + 2 * i)));
  }
}

#ifdef HEDGEHOP_HAS_AVX2
[[gnu::target("avx2")]] void add_products(const int16_t* a, const int16_t* b, int pairs, int32_t* sum) {
  int i = 0;
  const auto eight = [](const auto* p) __attribute__((target("avx2"))) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
  };
  for (; i + 8 <= pairs; i += 8) {
    const __m256i products = _mm256_madd_epi16(eight(a + 2 * i), eight(b + 2 * i));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(sum + i), _mm256_add_epi32(eight(sum + i), products));
  }
  for (; i < pairs; i += 4) {
    cv::v_store(sum + i, cv::v_load(sum + i) + cv::v_dotprod(cv::v_load(a + 2 * i), cv::v_load(b + 2 * i)));
  }
}
#endif

}  // namespace

PatchSums::PatchSums(std::span<const PatchRange> rows, std::span<const PatchRange> cols, int padded_width, int height,
                     int channels)
    : pairs_(padded_width / 2), channels_(channels) {
  if (rows.empty() || cols.empty() || channels < 1) throw std::invalid_argument("patch sums need patches and channels");
  if (padded_width % 8 != 0) throw std::invalid_argument("patch sums need rows padded to a multiple of 8");
  for (const PatchRange& c : cols) {
    if (c.begin % 2 != 0 || c.end % 2 != 0 || c.begin < 0 || c.end <= c.begin || c.end > padded_width) {
      throw std::invalid_argument("patch columns must begin and end at even pixels of the image");
    }
    cols_.push_back({c.begin / 2, c.end / 2});
  }
  const auto begins = [](const PatchRange& a, const PatchRange& b) { return a.begin < b.begin; };
  const auto ends = [](const PatchRange& a, const PatchRange& b) { return a.end < b.end; };
  constexpr int kGroup = 4;
  first_pair_ = std::min_element(cols_.begin(), cols_.end(), begins)->begin / kGroup * kGroup;
  end_pair_ = (std::max_element(cols_.begin(), cols_.end(), ends)->end + kGroup - 1) / kGroup * kGroup;
  for (const PatchRange& r : rows) {
    if (r.begin < 0 || r.end <= r.begin || r.end > height) {
      throw std::invalid_argument("patch rows must lie in the image");
    }
    boundaries_.push_back(r.begin);
    boundaries_.push_back(r.end);
  }
  std::sort(boundaries_.begin(), boundaries_.end());
  boundaries_.erase(std::unique(boundaries_.begin(), boundaries_.end()), boundaries_.end());
  const auto boundary = [&](int y) {
    return static_cast<int>(std::lower_bound(boundaries_.begin(), boundaries_.end(), y) - boundaries_.begin());
  };
  for (const PatchRange& r : rows) rows_.push_back({boundary(r.begin), boundary(r.end)});

  const size_t line = static_cast<size_t>(pairs_) * static_cast<size_t>(channels_);
  columns_.resize(line);
  kept_.resize(line * boundaries_.size());
  sideways_.resize(static_cast<size_t>(pairs_) + 1);
  sums_.resize(static_cast<size_t>(channels_) * rows_.size() * cols_.size());
}

void PatchSums::begin() {
  std::fill(columns_.begin(), columns_.end(), 0);
  row_ = first_row();
  next_boundary_ = 0;
  keep_columns();
}

void PatchSums::add(int channel, const int16_t* a, const int16_t* b) {
  int32_t* sum = columns_.data() + static_cast<ptrdiff_t>(channel) * pairs_;
  add_products(a + 2 * first_pair_, b + 2 * first_pair_, end_pair_ - first_pair_, sum + first_pair_);
}

void PatchSums::next_row() {
  ++row_;
  if (row_ != boundaries_[next_boundary_]) return;
  keep_columns();
  if (next_boundary_ == boundaries_.size()) sum_sideways();
}

void PatchSums::keep_columns() {
  std::copy(columns_.begin(), columns_.end(), kept_.begin() + static_cast<ptrdiff_t>(next_boundary_ * columns_.size()));
  ++next_boundary_;
}

void PatchSums::sum_sideways() {
  for (int channel = 0; channel < channels_; ++channel) {
    for (size_t row = 0; row < rows_.size(); ++row) {
      const auto kept = [&](int boundary) {
        return kept_.data() + (static_cast<ptrdiff_t>(boundary) * channels_ + channel) * pairs_;
      };
      const int32_t* top = kept(rows_[row].begin);
      const int32_t* bottom = kept(rows_[row].end);
      // The running sums are modulo 2^32, but their difference is exact.
      for (auto i = static_cast<size_t>(first_pair_); i < static_cast<size_t>(end_pair_); ++i) {
        const uint32_t difference = static_cast<uint32_t>(bottom[i]) - static_cast<uint32_t>(top[i]);
        sideways_[i + 1] = sideways_[i] + static_cast<int32_t>(difference);
      }
      for (size_t col = 0; col < cols_.size(); ++col) {
        sums_[index(channel, static_cast<int>(row), static_cast<int>(col))] =
            sideways_[static_cast<size_t>(cols_[col].end)] - sideways_[static_cast<size_t>(cols_[col].begin)];
      }
    }
  }
}

}  // namespace hedgehop::vision::flow
