#include "sim/pages/log_figure.h"

#include <fmt/format.h>

#include <array>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "sim/pages/figure_canvas.h"
#include "sim/pages/figure_plot.h"

namespace hedgehop::sim {
namespace {

constexpr double kPanelWidth = 230.0, kPanelHeight = 170.0, kLegend = 22.0;

/// One prediction in every panel.
struct Curve {
  std::string_view name, color;
  bool dashed;
  StateError HorizonErrors::*errors;
};
constexpr std::array<Curve, 4> kCurves = {{{"model", "#0072b2", false, &HorizonErrors::model},
                                           {"unchanged", "#8d97a6", true, &HorizonErrors::held},
                                           {"constant velocity", "#009e73", true, &HorizonErrors::constant_velocity},
                                           {"linear model", "#d55e00", true, &HorizonErrors::linear}}};

void draw_group(FigureCanvas& canvas, FigureCanvas::Point corner, const LogComparison& comparison, Eigen::Index group) {
  const double scale = group >= 2 ? 180.0 / std::numbers::pi : 1.0;
  std::vector<double> horizons{0.0}, all{0.0};
  std::array<std::vector<double>, kCurves.size()> values;
  for (const HorizonErrors& row : comparison.rows) {
    horizons.push_back(row.horizon_s);
    for (size_t c = 0; c < kCurves.size(); ++c) {
      values[c].push_back(scale * group_norms(row.*kCurves[c].errors)[group]);
      all.push_back(values[c].back());
    }
  }
  const auto g = static_cast<size_t>(group);
  const FigurePlot plot(canvas, corner, kPanelWidth, kPanelHeight, FigureAxis::of_numbers("horizon, s", horizons),
                        FigureAxis::of_numbers(fmt::format("RMSE of {}, {}", kStateGroups[g], kGroupUnits[g]), all));
  for (size_t c = 0; c < kCurves.size(); ++c) {
    std::vector<FigureCanvas::Point> line{plot.at(0.0, 0.0)};
    for (size_t h = 0; h < values[c].size(); ++h) line.push_back(plot.at(horizons[h + 1], values[c][h]));
    const std::string color(kCurves[c].color);
    canvas.line(line,
                {.fill = "", .stroke = color, .width = kCurves[c].dashed ? 1.0 : 1.75, .dashed = kCurves[c].dashed});
    for (size_t p = 1; p < line.size(); ++p) canvas.circle(line[p], 1.8, {.fill = color, .stroke = ""});
  }
}

}  // namespace

std::string log_figure(const LogComparison& comparison) {
  const Eigen::Index first = comparison.has_position ? 0 : 1;
  FigureCanvas canvas(kPanelWidth * static_cast<double>(4 - first), kPanelHeight + kLegend);
  for (Eigen::Index g = first; g < 4; ++g) {
    draw_group(canvas, {kPanelWidth * static_cast<double>(g - first), kLegend}, comparison, g);
  }
  double x = 40.0;
  for (const Curve& curve : kCurves) {
    canvas.line({{x, 10.0}, {x + 22.0, 10.0}},
                {.fill = "", .stroke = std::string(curve.color), .width = 1.75, .dashed = curve.dashed});
    canvas.text({x + 27.0, 13.0}, curve.name, 8.0);
    x += 45.0 + FigureCanvas::text_width(curve.name, 8.0);
  }
  return canvas.svg();
}

}  // namespace hedgehop::sim
