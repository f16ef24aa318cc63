#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/pages/figure_canvas.h"

namespace hedgehop::sim {

/// An axis of a figure: of numbers, or of words at 0, 1, 2 ...
struct FigureAxis {
  struct Tick {
    double value = 0.0;
    std::string words;
  };
  std::string label;
  double low = 0.0, high = 1.0;
  std::vector<Tick> ticks;

  /// Values that are not finite are ignored.
  static FigureAxis of_numbers(const std::string& label, const std::vector<double>& values);
  /// The axis of log10 of values > 0, with the values as ticks: all if they are few, else five of them.
  static FigureAxis of_logarithms(const std::string& label, std::vector<double> values);
  static FigureAxis of_words(const std::string& label, const std::vector<std::string>& words);
};

/// Draws two axes when it is made, and returns places on the canvas.
class FigurePlot {
 public:
  FigurePlot(FigureCanvas& canvas, FigureCanvas::Point corner, double width, double height, FigureAxis x, FigureAxis y);
  FigureCanvas::Point at(double x, double y) const;

 private:
  FigureAxis x_, y_;
  FigureCanvas::Point corner_;  ///< of the frame, top left
  double width_, height_;
};

/// Returns the text, cut with "..." to a width.
std::string shortened(std::string_view words, double width, double size);

/// Returns the color of a share, 0..1, from orange (worst) to blue (best): the ramp of the pages.
std::string ramp_color(double share);
/// Whether white text is readable on the color.
bool is_dark(std::string_view color);

}  // namespace hedgehop::sim
