#include "scenes/textures/canvas.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

namespace hedgehop::scenes::textures {
namespace {

using Lanes [[gnu::vector_size(16)]] = float;
constexpr size_t kLanes = 4;
constexpr size_t kBlock = 4;  // lanes that are summed in registers
constexpr size_t kBlockPx = kLanes * kBlock;

size_t blocks_of(int size_px) { return (static_cast<size_t>(size_px) + kBlockPx - 1) / kBlockPx; }

// Position of a pixel on a periodic lattice: the previous node and the eased weight of the next one.
struct LatticeStep {
  int before;
  float way;
};

std::vector<LatticeStep> lattice_steps(int size_px, int cells, double phase) {
  std::vector<LatticeStep> steps;
  steps.reserve(static_cast<size_t>(size_px));
  for (int i = 0; i < size_px; ++i) {
    const double at = static_cast<double>(i) * cells / size_px + phase;
    const int node = static_cast<int>(at);
    const double t = at - node;
    steps.push_back({node, static_cast<float>(t * t * (3.0 - 2.0 * t))});
  }
  return steps;
}

// Returns the number of unit_interval(), in operations that compilers vectorize. All of them are exact.
double unit_interval_of_halves(uint64_t bits) {
  const uint64_t whole = bits >> 11;
  const auto upper = std::bit_cast<double>(uint64_t{0x4530000000000000u} | (whole >> 32));  // 2^84 + 2^32 upper half
  const auto lower = std::bit_cast<double>(uint64_t{0x4330000000000000u} | (whole & 0xffffffffu));  // 2^52 + lower half
  return ((upper - 0x1.00000001p84) + lower) * 0x1p-53;
}

// Value noise on one lattice, computed row by row. Keeps the two adjacent lattice rows, interpolated across the image.
class Octave {
 public:
  // A row of the image between two lattice rows, in whole blocks.
  struct Row {
    const Lanes* above;
    const Lanes* below;
    float way;
  };

  Octave(int size_px, int cells_u, int cells_v, float strength, Random& random)
      : cells_u_(cells_u), cells_v_(cells_v), above_(kBlock * blocks_of(size_px)), below_(above_.size()) {
    draw_lattice(strength, random);
    // Random phases separate the nodes of the octaves.
    across_ = lattice_steps(size_px, cells_u, uniform(random, 0.0, 1.0));
    down_ = lattice_steps(size_px, cells_v, uniform(random, 0.0, 1.0));
  }

  Row row(int r) {
    const LatticeStep& s = down_[static_cast<size_t>(r)];
    if (s.before != before_) {
      if (s.before == before_ + 1) {
        std::swap(above_, below_);
      } else {
        spread(s.before, above_);
      }
      spread(s.before + 1, below_);
      before_ = s.before;
    }
    return {above_.data(), below_.data(), s.way};
  }

 private:
  // Draws the nodes row by row. Each row ends with its first two nodes again, so that no step needs to wrap around.
  void draw_lattice(float strength, Random& random) {
    const auto cells = static_cast<size_t>(cells_u_), stride = cells + 2;
    lattice_.resize(stride * static_cast<size_t>(cells_v_));
    for (float* nodes = lattice_.data(); nodes < lattice_.data() + lattice_.size(); nodes += stride) {
      for (size_t drawn = 0; drawn < cells;) {
        const std::span<const uint64_t> numbers = random.take(cells - drawn);
        float* const out = nodes + drawn;
        for (size_t i = 0; i < numbers.size(); ++i) {
          out[i] = static_cast<float>(-1.0 + 2.0 * unit_interval_of_halves(numbers[i])) * strength;
        }
        drawn += numbers.size();
      }
      nodes[cells] = nodes[0];
      nodes[cells + 1] = nodes[1 % cells];
    }
  }

  void spread(int row, std::vector<Lanes>& line) const {
    const float* const nodes = lattice_.data() + static_cast<ptrdiff_t>(row % cells_v_) * (cells_u_ + 2);
    const auto at = [nodes](const LatticeStep& s) {
      const float* const node = nodes + s.before;
      return node[0] + s.way * (node[1] - node[0]);
    };
    const LatticeStep* s = across_.data();
    const size_t whole = across_.size() / kLanes, rest = across_.size() % kLanes;
    for (size_t i = 0; i < whole; ++i, s += kLanes) line[i] = Lanes{at(s[0]), at(s[1]), at(s[2]), at(s[3])};
    for (size_t i = 0; i < rest; ++i) line[whole][i] = at(s[i]);
  }

  int cells_u_, cells_v_;
  std::vector<float> lattice_;
  std::vector<LatticeStep> across_, down_;
  std::vector<Lanes> above_, below_;
  int before_ = -2;  ///< lattice row in above_; the next one is in below_
};

std::vector<Octave> make_octaves(int size_px, const NoiseShape& shape, Random& random) {
  std::vector<Octave> octaves;
  octaves.reserve(static_cast<size_t>(std::max(0, shape.octaves)));
  int cells_u = shape.cells_u, cells_v = shape.cells_v;
  float strength = 1.0f;
  for (int octave = 0; octave < shape.octaves; ++octave) {
    if (cells_u > size_px || cells_v > size_px) break;
    octaves.emplace_back(size_px, cells_u, cells_v, strength, random);
    cells_u *= 2;
    cells_v *= 2;
    strength *= static_cast<float>(shape.gain);
  }
  return octaves;
}

// Sums of numbers and their squares, added in the order of the numbers, which makes the result reproducible.
struct Moments {
  double sum = 0.0, squares = 0.0;

  void add(const float* numbers, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      sum += numbers[i];
      squares += static_cast<double>(numbers[i]) * numbers[i];
    }
  }
};

// Writes one row of noise, the sum of its octaves. Meanwhile it adds the row before to the moments, because each
// addition has to wait for the one before.
// @param row  whole blocks. @param row_before  null for the first row. @return the moments with the row before.
Moments sum_row(std::span<const Octave::Row> octaves, float* row, const float* row_before, size_t size,
                Moments moments) {
  for (size_t first = 0; first < size; first += kBlockPx) {
    const size_t lane = first / kLanes;
    Lanes sum[kBlock] = {};
    for (const Octave::Row& octave : octaves) {
      for (size_t i = 0; i < kBlock; ++i) {
        const Lanes above = octave.above[lane + i], below = octave.below[lane + i];
        sum[i] += above + octave.way * (below - above);
      }
    }
    std::memcpy(row + first, sum, sizeof sum);
    if (row_before) moments.add(row_before + first, std::min(kBlockPx, size - first));
  }
  return moments;
}

}  // namespace

cv::Mat1f fractal_noise(int size_px, const NoiseShape& shape, Random& random) {
  std::vector<Octave> octaves = make_octaves(size_px, shape, random);
  const auto size = static_cast<size_t>(size_px);
  cv::Mat1f padded(size_px, static_cast<int>(kBlockPx * blocks_of(size_px)));
  std::vector<Octave::Row> rows(octaves.size());
  Moments moments;
  for (int r = 0; r < size_px; ++r) {
    std::ranges::transform(octaves, rows.begin(), [r](Octave& octave) { return octave.row(r); });
    moments = sum_row(rows, padded[r], r > 0 ? padded[r - 1] : nullptr, size, moments);
  }
  moments.add(padded[size_px - 1], size);

  const auto total = static_cast<double>(size * size);
  const double mean = moments.sum / total;
  const double deviation = std::sqrt(moments.squares / total - mean * mean);
  cv::Mat1f noise = padded.colRange(0, size_px);
  for (int r = 0; r < size_px; ++r) {
    for (float& number : std::span(noise[r], size)) number = static_cast<float>((number - mean) / deviation);
  }
  return noise;
}

}  // namespace hedgehop::scenes::textures
