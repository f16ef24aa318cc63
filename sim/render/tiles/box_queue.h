#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "sim/render/tiles/kernels.h"

namespace hedgehop::sim::tiles {

/// A queue of boxes from near to far, in steps of 6 % of the distance.
class BoxQueue {
 public:
  struct Entry {
    uint32_t child;  ///< as BoxTree::Node::children
    size_t drawn;    ///< Frame::surface_count when its visibility was tested
    PixelBox pixels;
    uint32_t next;  ///< the queue's own
  };

  /// @param boxes  number of boxes of the largest tree.
  void reserve(size_t boxes) { entries_.reserve(2 * boxes); }

  bool empty() const { return (used_[0] | used_[1] | used_[2] | used_[3]) == 0; }

  /// @param distance2_m2  square of the distance.
  void push(uint32_t child, size_t drawn, const PixelBox& pixels, float distance2_m2) {
    const uint32_t step = step_of(distance2_m2);
    uint64_t& used = used_[step / 64];
    const uint64_t bit = uint64_t{1} << step % 64;
    entries_.push_back({child, drawn, pixels, (used & bit) != 0 ? first_[step] : kNone});
    first_[step] = static_cast<uint32_t>(entries_.size() - 1);
    used |= bit;
  }

  /// Removes the nearest entry. The queue must not be empty.
  Entry pop() {
    size_t word = 0;
    while (used_[word] == 0) ++word;
    const size_t step = 64 * word + static_cast<size_t>(std::countr_zero(used_[word]));
    const Entry entry = entries_[first_[step]];
    first_[step] = entry.next;
    if (entry.next == kNone) used_[word] &= used_[word] - 1;
    if (empty()) entries_.clear();
    return entry;
  }

 private:
  static constexpr uint32_t kNone = 0xffffffffu, kSteps = 256;

  /// Eight steps per power of two of the square, from 1 m2 on.
  static uint32_t step_of(float distance2_m2) {
    constexpr uint32_t kBits = 20, kFirst = 127 << 3;
    const uint32_t step = std::bit_cast<uint32_t>(distance2_m2) >> kBits;
    return step < kFirst ? 0 : step - kFirst < kSteps ? step - kFirst : kSteps - 1;
  }

  std::array<uint64_t, kSteps / 64> used_{};  ///< steps with entries
  std::array<uint32_t, kSteps> first_{};      ///< entry of each used step
  std::vector<Entry> entries_;
};

}  // namespace hedgehop::sim::tiles
