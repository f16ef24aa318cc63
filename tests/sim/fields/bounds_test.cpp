#include "sim/fields/bounds.h"
#include "sim/fields/field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace hedgehop::fields {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

struct Disc {
  static constexpr std::string_view kName = "disc";
  double radius_m = 1.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<Disc> auto& c) {
  v("radius", c.radius_m, {.unit = "m", .above = 0.0});
}

struct Bar {
  static constexpr std::string_view kName = "bar";
  Eigen::Vector2d size_m{1.0, 2.0};
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<Bar> auto& c) {
  v("size", c.size_m, {.unit = "m", .above = 0.0});
}

struct Machine {
  enum class Color { grey, red };
  double tilt_rad = 0.0;
  double trim = 0.0;
  double gap_m = 0.0;
  int blades = 2;
  Color color = Color::grey;
  std::optional<Disc> tail;
  std::vector<Disc> rotors;
  std::variant<Disc, Bar> body;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<Machine> auto& c) {
  v("tilt", c.tilt_rad, {.unit = "deg", .at_least = -90.0, .below = 90.0});
  v("trim", c.trim, {});
  v("gap", c.gap_m, {.unit = "m"});
  v("blades", c.blades, {.at_least = 2, .at_most = 8});
  v("color", c.color, {.choices = {"grey", "red"}});
  v("tail", c.tail, {});
  v("rotors", c.rotors, {});
  v("body", c.body, {});
}

/// The message with which a machine is refused after a change; "" when it is taken.
std::string refusal(const std::function<void(Machine&)>& change, std::string_view prefix = "") {
  Machine machine;
  change(machine);
  try {
    require_bounds(machine, prefix);
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
  return "";
}

TEST(RequireBounds, NamesKeyValueAndBound) {
  EXPECT_EQ(refusal([](Machine&) {}), "");
  EXPECT_EQ(refusal([](Machine& m) { m.blades = 9; }), "blades: must be <= 8, got 9");
  EXPECT_EQ(refusal([](Machine& m) { m.blades = 1; }, "vehicle"), "vehicle.blades: must be >= 2, got 1");
  EXPECT_EQ(refusal([](Machine& m) { m.color = static_cast<Machine::Color>(2); }),
            "color: must be one of its choices, got 2");
}

TEST(RequireBounds, JudgesAnglesInDegrees) {
  EXPECT_EQ(refusal([](Machine& m) { m.tilt_rad = to_radians(-90.0L); }), "");
  EXPECT_EQ(refusal([](Machine& m) { m.tilt_rad = to_radians(90.0L); }), "tilt: must be < 90 deg, got 90");
  EXPECT_EQ(refusal([](Machine& m) { m.tilt_rad = to_radians(-91.0L); }), "tilt: must be >= -90 deg, got -91");
}

TEST(RequireBounds, RefusesNumbersThatAreNotFiniteWithoutABound) {
  EXPECT_EQ(refusal([](Machine& m) { m.trim = std::nan(""); }), "trim: must be finite, got nan");
  EXPECT_EQ(refusal([](Machine& m) { m.trim = -std::numeric_limits<double>::infinity(); }),
            "trim: must be finite, got -inf");
  EXPECT_EQ(refusal([](Machine& m) { m.trim = 1e308; }), "");
}

TEST(RequireBounds, BoundsALengthThatStatesNone) {
  EXPECT_EQ(refusal([](Machine& m) { m.gap_m = -100e3; }), "");
  EXPECT_EQ(refusal([](Machine& m) { m.gap_m = 1e308; }), "gap: must be <= 100000 m, got 1e+308");
  EXPECT_EQ(refusal([](Machine& m) { m.tail = Disc{2e5}; }), "tail.radius: must be <= 100000 m, got 200000");
}

TEST(RequireBounds, EntersStructsListsAndVariants) {
  EXPECT_EQ(refusal([](Machine& m) { m.tail = Disc{0.0}; }), "tail.radius: must be > 0 m, got 0");
  EXPECT_EQ(refusal([](Machine& m) { m.rotors = {{1.0}, {-0.5}}; }), "rotors.1.radius: must be > 0 m, got -0.5");
  EXPECT_EQ(refusal([](Machine& m) { m.body = Bar{{1.0, 0.0}}; }), "body.size.1: must be > 0 m, got 0");
  EXPECT_EQ(refusal([](Machine& m) { m.body = Disc{0.0}; }), "body.radius: must be > 0 m, got 0");
}

}  // namespace
}  // namespace hedgehop::fields
