#include "sim/cli/flight_pace.h"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

namespace hedgehop::sim::cli {
namespace {

using Seconds = std::chrono::duration<double>;
constexpr double kNanosecond = 1e-9;

/// A clock that moves when a test moves it, and when it waits.
struct FakeClock {
  PaceClock::Time at{};
  std::vector<double> waits_s;

  void pass(double s) { at += std::chrono::duration_cast<PaceClock::Time::duration>(Seconds(s)); }
  PaceClock clock() {
    return {[this] { return at; },
            [this](PaceClock::Time due) {
              waits_s.push_back(Seconds(due - at).count());
              at = due;
            }};
  }
  double now_s() const { return Seconds(at.time_since_epoch()).count(); }
};

TEST(FlightPace, WaitsForTheRestOfEachStep) {
  FakeClock fake;
  FlightPace pace(1.0, fake.clock());
  for (int step = 1; step <= 10; ++step) {
    fake.pass(0.03);  // the simulation of a step of 0.1 s
    pace.keep(0.1 * step);
    EXPECT_NEAR(fake.now_s(), 0.1 * step, kNanosecond);
    EXPECT_NEAR(fake.waits_s.back(), 0.07, kNanosecond);
  }
}

TEST(FlightPace, SpeedScalesTheWallTime) {
  FakeClock fake;
  FlightPace pace(4.0, fake.clock());
  pace.keep(2.0);
  EXPECT_NEAR(fake.now_s(), 0.5, kNanosecond);
}

TEST(FlightPace, CatchesUpAfterAShortDelay) {
  FakeClock fake;
  FlightPace pace(1.0, fake.clock());
  fake.pass(0.2);
  pace.keep(0.1);  // 0.1 s behind: no wait
  EXPECT_TRUE(fake.waits_s.empty());
  pace.keep(0.5);
  EXPECT_NEAR(fake.now_s(), 0.5, kNanosecond);
}

TEST(FlightPace, BeginsAgainAfterALongDelay) {
  FakeClock fake;
  FlightPace pace(1.0, fake.clock());
  fake.pass(3.0);
  pace.keep(0.1);
  pace.keep(0.6);
  EXPECT_NEAR(fake.now_s(), 3.5, kNanosecond);
}

}  // namespace
}  // namespace hedgehop::sim::cli
