#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "avoidance/module.h"

/// The contract that every module must fulfill, as tests for modules inside and outside this tree.
namespace hedgehop::avoidance::contract {

/// Input of one decision.
struct Step {
  NavigationState navigation;
  std::vector<CameraFrame> frames;
};

/// The module under test (a new object per call of make()) and its test input.
struct Subject {
  std::function<std::unique_ptr<Module>()> make;
  Setup setup;
  std::vector<Step>
      steps;  ///< frames and navigation of one flight; at least three steps, each with all required frames
  int64_t period_ns = 40'000'000;
  Goal goal;

  Observation observation(size_t i) const { return observation(steps.at(i), i); }
  Observation observation(const Step& step, size_t i) const {
    return {period_ns * static_cast<int64_t>(i), step.frames, step.navigation, goal};
  }
  std::vector<Decision> fly(Module& module, bool annotate = false) const {
    module.reset(setup);
    std::vector<Decision> decisions;
    for (size_t i = 0; i < steps.size(); ++i) {
      decisions.push_back(module.update(observation(i)));
      if (annotate) module.annotate();
    }
    return decisions;
  }
};

/// Returns all numbers of a decision as bit patterns, so that NaN equals NaN.
inline std::vector<uint64_t> bits(const Decision& decision) {
  std::vector<double> numbers = decision.signals;
  std::visit(
      [&](const auto& c) {
        if constexpr (requires { c.v_WB_W; }) numbers.insert(numbers.end(), {c.v_WB_W.x(), c.v_WB_W.y()});
        if constexpr (requires { c.p_WB; }) numbers.insert(numbers.end(), {c.p_WB.x(), c.p_WB.y(), c.p_WB.z()});
        if constexpr (requires { c.roll_rad; }) numbers.insert(numbers.end(), {c.roll_rad, c.pitch_rad});
        if constexpr (requires { c.altitude_m; }) numbers.push_back(c.altitude_m);
        if constexpr (requires { c.heading_rad; }) numbers.push_back(c.heading_rad);
        if constexpr (requires { c.yaw_rate_radps; }) numbers.push_back(c.yaw_rate_radps);
      },
      decision.command);
  std::vector<uint64_t> result = {decision.command.index()};
  for (const double number : numbers) result.push_back(std::bit_cast<uint64_t>(number));
  return result;
}

inline void expect_same(const std::vector<Decision>& a, const std::vector<Decision>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(bits(a[i]), bits(b[i])) << i;
    EXPECT_EQ(a[i].status, b[i].status) << i;
  }
}

inline void expect_same_input_gives_the_same_bits(const Subject& subject) {
  expect_same(subject.fly(*subject.make()), subject.fly(*subject.make()));
}

inline void expect_reset_equals_a_new_module(const Subject& subject) {
  const auto used = subject.make(), fresh = subject.make();
  subject.fly(*used);
  expect_same(subject.fly(*used), subject.fly(*fresh));
}

inline void expect_drawing_changes_nothing_and_gives_rgb(const Subject& subject) {
  const auto drawn = subject.make(), plain = subject.make(), unused = subject.make();
  expect_same(subject.fly(*drawn, /*annotate=*/true), subject.fly(*plain));
  const cv::Mat image = drawn->annotate();
  EXPECT_TRUE(image.empty() || image.type() == CV_8UC3);
  EXPECT_NO_THROW(unused->annotate());
}

inline void expect_speed_limits_hold(Subject subject) {
  subject.setup.limits.speed_mps = 0.7;
  for (const Decision& decision : subject.fly(*subject.make())) {
    if (const auto* velocity = std::get_if<VelocityCommand>(&decision.command)) {
      EXPECT_LE(velocity->v_WB_W.norm(), 0.7 + 1e-12);
    }
  }
}

inline void expect_missing_frames_are_survived(const Subject& subject) {
  const auto module = subject.make();
  module->reset(subject.setup);
  for (size_t i = 0; i < subject.steps.size(); ++i) {
    Step step = subject.steps[i];
    if (i == 1) step.frames.clear();
    if (i == 2 && !step.frames.empty()) step.frames.pop_back();
    EXPECT_NO_THROW(module->update(subject.observation(step, i)));
  }
}

inline void expect_navigation_that_is_not_finite_is_rejected(const Subject& subject) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto refuse = [&](auto change) {
    const auto module = subject.make();
    module->reset(subject.setup);
    Observation bad = subject.observation(0);
    change(bad);
    EXPECT_THROW(module->update(bad), std::logic_error);
  };
  refuse([](Observation& o) { o.navigation.p_WB_est.x() = kNan; });
  refuse([](Observation& o) { o.navigation.q_WB_est.w() = kNan; });
  refuse([](Observation& o) { o.navigation.v_WB_B_est.y() = INFINITY; });
  refuse([](Observation& o) { o.navigation.w_WB_B_est.z() = kNan; });
  refuse([](Observation& o) { o.navigation.q_WB_gyro.x() = kNan; });
  refuse([](Observation& o) { o.navigation.height_above_ground_m = kNan; });
  refuse([](Observation& o) { o.navigation.range_m = INFINITY; });
  refuse([](Observation& o) { o.goal.p_WG.z() = kNan; });
  refuse([](Observation& o) { o.goal.heading_rad = kNan; });
}

inline void expect_signals_and_metrics_are_named_once_and_steady(const Subject& subject) {
  const auto module = subject.make();
  const std::vector<Signal> before = module->signals();
  const std::vector<Decision> decisions = subject.fly(*module);
  std::set<std::string> names;
  for (const Signal& signal : before) {
    EXPECT_TRUE(names.insert(signal.name).second) << signal.name;
    EXPECT_EQ(signal.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos) << signal.name;
  }
  EXPECT_EQ(module->signals().size(), before.size());
  for (const Decision& decision : decisions) {
    EXPECT_EQ(decision.signals.size(), before.size());
    EXPECT_FALSE(decision.status.empty());
    EXPECT_EQ(decision.status.find_first_of(" ,\"\n"), std::string::npos);
  }
  for (const Metric& metric : module->metrics()) EXPECT_FALSE(std::isinf(metric.value)) << metric.name;
}

inline void expect_all_needed_cameras_must_be_there(const Subject& subject) {
  const auto module = subject.make();
  for (const CameraNeed& need : module->needs().cameras) {
    Setup blind = subject.setup;
    std::erase_if(blind.cameras, [&](const MountedCamera& camera) { return camera.role == need.role; });
    EXPECT_THROW(module->reset(blind), std::invalid_argument) << need.role;
  }
}

/// Checks the whole contract.
inline void expect_module(const Subject& subject) {
  expect_same_input_gives_the_same_bits(subject);
  expect_reset_equals_a_new_module(subject);
  expect_drawing_changes_nothing_and_gives_rgb(subject);
  expect_speed_limits_hold(subject);
  expect_missing_frames_are_survived(subject);
  expect_navigation_that_is_not_finite_is_rejected(subject);
  expect_signals_and_metrics_are_named_once_and_steady(subject);
  expect_all_needed_cameras_must_be_there(subject);
}

}  // namespace hedgehop::avoidance::contract
