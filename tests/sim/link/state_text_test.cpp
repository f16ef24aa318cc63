#include "sim/link/state_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

namespace hedgehop::sim::link {
namespace {

PhysicsState tilted_state() {
  PhysicsState state{.step = 250, .time_s = 0.25};
  state.body.p_WB = {12.25, -3.5, -10.125};
  state.body.q_WB = dynamics::from_roll_pitch_heading(0.1, -0.2, 2.5);
  state.body.v_WB_B = {1.5, -0.25, 0.125};
  state.body.w_WB_B = {1e-7, -0.02, 3.0};
  state.specific_force_B = {0.5, -0.25, -9.75};
  state.wind_W = {-2.0, 1.0, 0.0};
  return state;
}

std::string text_of(const PhysicsState& state) {
  std::string text;
  EXPECT_TRUE(write_state(state, text));
  return text;
}

/// The reader of ArduPilot 4.1 to 4.5: takes the text between the last two newlines, and finds each key as a substring
/// after its section's name. A value begins two characters after the key, at `[` for a vector.
class SubstringScanner {
 public:
  explicit SubstringScanner(const std::string& text) {
    const size_t end = text.rfind('\n');
    if (end == std::string::npos || end == 0) return;
    const size_t begin = text.rfind('\n', end - 1);
    if (begin != std::string::npos) line_ = text.substr(begin + 1, end - begin - 1);
  }
  std::optional<double> number(const std::string& section, const std::string& key) const {
    const std::optional<size_t> at = value_at(section, key);
    if (!at) return std::nullopt;
    char* end = nullptr;
    const double value = std::strtod(line_.c_str() + *at, &end);
    return end == line_.c_str() + *at ? std::nullopt : std::optional(value);
  }
  std::optional<Eigen::Vector3d> vector(const std::string& section, const std::string& key) const {
    const std::optional<size_t> at = value_at(section, key);
    Eigen::Vector3d v;
    if (!at || std::sscanf(line_.c_str() + *at, "[%lf, %lf, %lf]", &v.x(), &v.y(), &v.z()) != 3) return std::nullopt;
    return v;
  }
  const std::string& line() const { return line_; }

 private:
  std::optional<size_t> value_at(const std::string& section, const std::string& key) const {
    const size_t in = line_.find(section);
    if (in == std::string::npos) return std::nullopt;
    const size_t at = line_.find(key, in + section.size());
    return at == std::string::npos ? std::nullopt : std::optional(at + key.size() + 2);
  }
  std::string line_;
};

TEST(StateText, ScannerOfSubstringsFindsEveryValue) {
  const PhysicsState state = tilted_state();
  const SubstringScanner scanner(text_of(state));
  EXPECT_NEAR(scanner.number("", "timestamp").value(), 0.25 + 250 * 1e-10, 1e-12);
  EXPECT_EQ(scanner.vector("imu", "gyro").value(), state.body.w_WB_B);
  EXPECT_EQ(scanner.vector("imu", "accel_body").value(), state.specific_force_B);
  EXPECT_EQ(scanner.vector("", "position").value(), state.body.p_WB);
  EXPECT_LT((scanner.vector("", "attitude").value() - Eigen::Vector3d(0.1, -0.2, 2.5)).norm(), 1e-12);
  const Eigen::Vector3d v_WB_W = state.body.q_WB * state.body.v_WB_B;
  EXPECT_EQ(scanner.vector("", "velocity").value(), v_WB_W);
  EXPECT_EQ(scanner.vector("", "velocity_wind").value(), state.wind_W);
  EXPECT_NEAR(scanner.number("", "airspeed").value(), (v_WB_W - state.wind_W).norm(), 1e-12);
}

TEST(StateText, QuaternionIsScalarFirstFromBodyToWorld) {
  const PhysicsState state = tilted_state();
  const std::string line = SubstringScanner(text_of(state)).line();
  Eigen::Quaterniond q;
  ASSERT_EQ(std::sscanf(line.c_str() + line.find("quaternion"), "quaternion\":[%lf,%lf,%lf,%lf]", &q.w(), &q.x(),
                        &q.y(), &q.z()),
            4);
  EXPECT_EQ(q.coeffs(), state.body.q_WB.coeffs());
}

TEST(StateText, IsOneLineOfAsciiWithoutSpacesBetweenNewlines) {
  const double ranges_m[] = {3.25};
  PhysicsState state = tilted_state();
  state.range_m = ranges_m;
  const std::string text = text_of(state);
  EXPECT_EQ(text.front(), '\n');
  EXPECT_EQ(text.back(), '\n');
  EXPECT_LT(text.size(), 4096u);
  for (const char c : text.substr(1, text.size() - 2)) EXPECT_TRUE(c > ' ' && c < 127) << static_cast<int>(c);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(StateText, OneRangeFinderIsSentAsSix) {
  const double ranges_m[] = {3.25, std::numeric_limits<double>::infinity()};
  PhysicsState state = tilted_state();
  state.range_m = ranges_m;
  const SubstringScanner scanner(text_of(state));
  EXPECT_EQ(scanner.number("", "rng_1"), 3.25);
  for (const char* key : {"rng_2", "rng_3", "rng_4", "rng_5", "rng_6"}) EXPECT_EQ(scanner.number("", key), -1.0) << key;
  EXPECT_EQ(text_of(tilted_state()).find("rng"), std::string::npos);
}

TEST(StateText, IsNotWrittenForAStateThatIsNotFinite) {
  std::string text;
  PhysicsState state = tilted_state();
  state.body.v_WB_B.x() = std::nan("");
  EXPECT_FALSE(write_state(state, text));
  state = tilted_state();
  state.specific_force_B.z() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(write_state(state, text));
}

/// The autopilot's clock counts whole microseconds and cuts each step.
TEST(StateText, ClockOfTheAutopilotKeepsEveryStepOf20Seconds) {
  for (const int64_t rate_hz : {250, 400, 500, 1000}) {
    double last_s = 0.0;
    int64_t clock_us = 0;
    PhysicsState state = tilted_state();
    std::string text;
    for (int64_t step = 1; step <= 20 * rate_hz; ++step) {
      state.step = step;
      state.time_s = static_cast<double>(step) / static_cast<double>(rate_hz);
      ASSERT_TRUE(write_state(state, text));
      const double time_s = std::strtod(text.c_str() + text.find(':') + 1, nullptr);
      clock_us += static_cast<int64_t>((time_s - last_s) * 1e6);
      last_s = time_s;
    }
    EXPECT_EQ(clock_us, 20'000'000) << rate_hz;
  }
}

}  // namespace
}  // namespace hedgehop::sim::link
