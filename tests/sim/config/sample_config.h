#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/fields/field.h"
#include "sim/fields/field_types.h"

/// A config with every kind of field, for tests that must not change when a vehicle does.
namespace hedgehop::sample {

struct Round {
  static constexpr std::string_view kName = "round";
  static constexpr std::string_view kMeaning = "a disc";
  double radius_m = 1.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<Round> auto& c) {
  v("radius", c.radius_m, {.unit = "m", .above = 0.0, .meaning = "radius"});
}

struct Square {
  static constexpr std::string_view kName = "square";
  static constexpr std::string_view kMeaning = "a square";
  double side_m = 2.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<Square> auto& c) {
  v("side", c.side_m, {.unit = "m", .above = 0.0, .required = true, .meaning = "side"});
}
using Shape = std::variant<Round, Square>;

struct Rotor {
  int blade_count = 2;
  double radius_m = 0.9;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<Rotor> auto& c) {
  v("blade_count", c.blade_count, {.at_least = 1, .at_most = 8, .meaning = "blades"});
  v("radius", c.radius_m, {.unit = "m", .above = 0.0, .meaning = "of the disc"});
}

enum class Color { grey, color };

struct Sample {
  double mass_kg = 8.0;
  double tilt_rad = 0.35;
  double rate_radps = 1.0;
  double trim = 0.0;
  int whole = 1;
  int64_t large = -1;
  uint64_t seed = 1;
  bool on = true;
  std::string name = "sample";
  Color color = Color::grey;
  Rotor rotor;
  std::vector<Rotor> rotors;
  std::vector<double> gains = {1.0, 2.0};
  std::vector<std::string> words;
  Eigen::Vector2d size_m = {1.0, 2.0};
  Eigen::Vector3d lever_rad = {0.0, 0.1, 0.2};
  std::optional<double> delay_s;
  std::optional<Rotor> tail = Rotor{};
  Shape shape;
  std::vector<Shape> shapes;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<Sample> auto& c) {
  v("mass", c.mass_kg, {.unit = "kg", .above = 0.0, .below = 100.0, .meaning = "mass"});
  v("tilt", c.tilt_rad, {.unit = "deg", .at_least = -60.0, .at_most = 60.0, .meaning = "tilt"});
  v("rate", c.rate_radps, {.unit = "deg/s", .meaning = "rate"});
  v("trim", c.trim, {.meaning = "trim"});
  v("whole", c.whole, {.meaning = "whole"});
  v("large", c.large, {.meaning = "large"});
  v("seed", c.seed, {.meaning = "seed"});
  v("on", c.on, {.meaning = "on"});
  v("name", c.name, {.meaning = "name"});
  v("color", c.color, {.choices = {"grey", "color"}, .meaning = "color"});
  v("rotor", c.rotor, {.meaning = "main rotor"});
  v("rotors", c.rotors, {.meaning = "rotors"});
  v("gains", c.gains, {.at_least = 0.0, .meaning = "gains"});
  v("words", c.words, {.meaning = "words"});
  v("size", c.size_m, {.unit = "m", .meaning = "size"});
  v("lever", c.lever_rad, {.unit = "deg", .meaning = "lever"});
  v("delay", c.delay_s, {.unit = "s", .at_least = 0.0, .meaning = "delay"});
  v("tail", c.tail, {.meaning = "tail rotor"});
  v("shape", c.shape, {.meaning = "shape"});
  v("shapes", c.shapes, {.selector = "check", .meaning = "shapes"});
}

}  // namespace hedgehop::sample
