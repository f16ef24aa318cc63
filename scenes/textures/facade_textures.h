#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "scenes/textures/canvas.h"

namespace hedgehop::scenes::textures {

/// How the walls of one kind of building look. An image shows `bays` x `floors` cells of one window each.
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

/// The kinds of walls that a city draws from.
const std::vector<FacadeStyle>& facade_styles();

/// Returns `variants` images of one style, CV_8UC3. They differ in windows, balconies and streaks, share the wall
/// between the cells, and so continue each other in any arrangement: a facade made of them never repeats strictly.
std::vector<cv::Mat> paint_facades(const FacadeStyle& style, int size_px, int variants, uint64_t seed);

}  // namespace hedgehop::scenes::textures
