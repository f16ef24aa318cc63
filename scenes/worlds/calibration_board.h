#pragma once

#include <cstdint>
#include <string_view>

#include "scenes/additions.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes::worlds {

/// A checkerboard on a meadow, for calibration tools: upright, facing south, its middle on the axis of W's north. The
/// north-west square is black; a white margin of one square surrounds the pattern. Every square is a face of its own,
/// so its edges are exact at any distance.
struct CheckerboardConfig {
  static constexpr std::string_view kName = "checkerboard";
  static constexpr std::string_view kMeaning = "a calibration board of black and white squares";

  double north_m = 3.0;
  double altitude_m = 2.0;
  int64_t columns = 9, rows = 6;
  double square_m = 0.1;
  SceneAdditions added;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<CheckerboardConfig> auto& c) {
  v("north", c.north_m, {.unit = "m", .at_least = -100.0, .at_most = 100.0, .meaning = "position of the board's face"});
  v("altitude", c.altitude_m, {.unit = "m", .above = 0.0, .at_most = 100.0, .meaning = "height of the board's middle"});
  v("columns", c.columns, {.at_least = 2, .at_most = 100, .meaning = "inner corners in a row, as OpenCV counts"});
  v("rows", c.rows, {.at_least = 2, .at_most = 100, .meaning = "inner corners in a column"});
  v("square", c.square_m, {.unit = "m", .above = 0.0, .at_most = 10.0, .meaning = "side of a square"});
  describe(v, c.added);
}

/// A grid of AprilTags of the family 36h11 on a meadow, placed as a checkerboard, in the layout of Kalibr: tag 0 at the
/// bottom left, numbers to the right, then upward; a black square in each gap between four tags.
struct AprilGridConfig {
  static constexpr std::string_view kName = "aprilgrid";
  static constexpr std::string_view kMeaning = "a calibration board of AprilTags";
  static constexpr int64_t kMaxTags = 88;

  double north_m = 3.0;
  double altitude_m = 2.0;
  int64_t columns = 6, rows = 6;
  double tag_m = 0.088;
  double spacing = 0.3;
  int64_t border = 2;
  SceneAdditions added;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<AprilGridConfig> auto& c) {
  v("north", c.north_m, {.unit = "m", .at_least = -100.0, .at_most = 100.0, .meaning = "position of the board's face"});
  v("altitude", c.altitude_m, {.unit = "m", .above = 0.0, .at_most = 100.0, .meaning = "height of the board's middle"});
  v("columns", c.columns, {.at_least = 1, .at_most = 44, .meaning = "tags in a row"});
  v("rows", c.rows, {.at_least = 1, .at_most = 44, .meaning = "tags in a column"});
  v("tag", c.tag_m,
    {.unit = "m", .above = 0.0, .at_most = 10.0, .meaning = "side of a tag, its black border included"});
  v("spacing", c.spacing, {.above = 0.0, .at_most = 1.0, .meaning = "gap between tags over the side of a tag"});
  v("border", c.border,
    {.at_least = 1, .at_most = 2, .meaning = "cells of the black border: 2 for Kalibr, 1 for AprilTag 3"});
  describe(v, c.added);
}

/// Throw std::invalid_argument with the field, its value and the valid values: a board that reaches below the ground,
/// or has more tags than kMaxTags.
Scene make_checkerboard(const CheckerboardConfig& config, uint64_t seed);
Scene make_aprilgrid(const AprilGridConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
