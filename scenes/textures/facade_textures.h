#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "scenes/textures/canvas.h"

namespace hedgehop::scenes::textures {

/// Appearance of the walls of one kind of building. A texture contains `bays` x `floors` cells with one window each.
struct FacadeStyle {
  enum class Wall { brick, plaster, panel, ashlar, glass };

  Wall wall = Wall::brick;
  Color wall_color;
  Color trim_color;  ///< frames, sills, bands
  int bays = 4;
  int floors = 4;
  double window_width = 0.45;   ///< share of the cell
  double window_height = 0.55;  ///< share of the cell
  int panes_across = 2;
  int panes_down = 2;
  double balcony_share = 0.0;
  bool floor_bands = false;

  static constexpr double kTileM = 12.0;
  double bay_m() const { return kTileM / bays; }
  double floor_m() const { return kTileM / floors; }
};

/// Returns the styles available to a city.
const std::vector<FacadeStyle>& facade_styles();

/// Returns `variants` textures of one style, CV_8UC3. They differ in windows, balconies and streaks, but share the wall
/// between the cells. They therefore match at their borders in any arrangement, and a facade does not repeat exactly.
std::vector<cv::Mat> paint_facades(const FacadeStyle& style, int size_px, int variants, uint64_t seed);

}  // namespace hedgehop::scenes::textures
