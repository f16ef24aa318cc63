#include "vision/stereo/row_slopes.h"

#include <algorithm>

#include "vision/flow/wide_integers.h"

namespace hedgehop::vision::stereo {

HEDGEHOP_WIDE void row_slopes(const uint8_t* above, const uint8_t* here, const uint8_t* below, int width,
                              uint8_t* slopes) {
  for (int x = 1; x < width - 1; ++x) {
    const auto slope = static_cast<int16_t>((here[x + 1] - here[x - 1]) * 2 + above[x + 1] - above[x - 1] +
                                            below[x + 1] - below[x - 1]);
    slopes[x] = static_cast<uint8_t>(std::clamp<int16_t>(slope, -kMaxSlope, kMaxSlope) + kMaxSlope);
  }
}

}  // namespace hedgehop::vision::stereo
