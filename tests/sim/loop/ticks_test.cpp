#include "sim/loop/ticks.h"

#include <gtest/gtest.h>

namespace hedgehop::sim {
namespace {

constexpr int64_t kDayS = 86400;

TEST(Ticks, ATimeIsTheExactQuotientRoundedOnce) {
  for (const int64_t rate_hz : {50, 300, 500, 600, 700, 900, 1750, 9973, 10000}) {
    const Ticks ticks(rate_hz);
    for (const int64_t begin : {int64_t{0}, kDayS * rate_hz - 3000}) {
      for (int64_t tick = begin; tick < begin + 3000; ++tick) {
        const int64_t error = 2 * (ticks.t_ns(tick) * rate_hz - tick * 1'000'000'000);
        ASSERT_LE(error, rate_hz) << tick << " at " << rate_hz << " Hz";
        ASSERT_GT(error, -rate_hz) << tick << " at " << rate_hz << " Hz";
        ASSERT_EQ(ticks.tick(ticks.t_ns(tick)), tick);
      }
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim
