#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "sim/batch/folders.h"
#include "sim/config/numbers.h"
#include "sim/config/whole_file.h"
#include "sim/pages/figure_canvas.h"
#include "sim/pages/figure_plot.h"
#include "sim/pages/sweep_analysis.h"
#include "sim/pages/sweep_tables.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
using Point = FigureCanvas::Point;

constexpr double kWidth = 252.0, kHeight = 189.0;  // 3.5 inches: a column of a paper
constexpr const char *kBlue = "#0072b2", *kOrange = "#d55e00", *kGrey = "#8d97a6";
constexpr size_t kMaxLevels = 16, kBins = 8, kPointsInBin = 4;

/// A parameter on an axis: each point's place, and its level or range.
struct Places {
  FigureAxis axis;
  std::vector<double> at;                ///< of each point
  std::vector<size_t> level;             ///< of each point
  std::vector<std::string> level_words;  ///< in their order
  std::vector<double> level_at;
};

bool varies_in(const SweepTable& points, size_t parameter) {
  return std::ranges::any_of(points.values, [&](const auto& v) { return v[parameter] != points.values[0][parameter]; });
}

/// Whether any parameter but this one varies.
bool others_vary(const SweepTable& points, size_t parameter) {
  for (size_t p = 0; p < points.paths.size(); ++p) {
    if (p != parameter && varies_in(points, p)) return true;
  }
  return false;
}

Places places_of(const SweepAnalysis& analysis, size_t parameter) {
  const SweepTable& points = analysis.points;
  Places places;
  std::vector<double> numbers;
  std::vector<std::string> words;
  for (const auto& values : points.values) {
    const ParsedNumber parsed = parse_number(values[parameter], false);
    if (parsed.kind == ParsedNumber::Kind::number) numbers.push_back(parsed.member);
    if (std::ranges::find(words, values[parameter]) == words.end()) words.push_back(values[parameter]);
  }
  const std::string& name = analysis.labels.at(points.paths[parameter]);
  if (numbers.size() != points.values.size()) {
    places.axis = FigureAxis::of_words(name, words);
    for (const auto& values : points.values) {
      places.level.push_back(static_cast<size_t>(std::ranges::find(words, values[parameter]) - words.begin()));
      places.at.push_back(static_cast<double>(places.level.back()));
    }
    for (size_t i = 0; i < words.size(); ++i) places.level_at.push_back(static_cast<double>(i));
    places.level_words = words;
    return places;
  }
  const bool log = analysis.log[parameter] && std::ranges::min(numbers) > 0.0;
  places.axis = log ? FigureAxis::of_logarithms(name, numbers) : FigureAxis::of_numbers(name, numbers);
  places.at = numbers;
  if (log) std::ranges::transform(numbers, places.at.begin(), [](double number) { return std::log10(number); });
  std::vector<double> levels = places.at;
  std::ranges::sort(levels);
  levels.erase(std::ranges::unique(levels).begin(), levels.end());
  // As on the page: ranges if most levels have a single point, so that a mean has several points.
  const bool single = others_vary(points, parameter) && 3 * levels.size() > 2 * numbers.size();
  const size_t bins = single ? std::clamp(numbers.size() / kPointsInBin, size_t{2}, kBins) : kBins;
  const double low = levels.front(), step = (levels.back() - low) / static_cast<double>(bins);
  const bool ranges = levels.size() > kMaxLevels || single;
  if (ranges) {
    levels.clear();
    for (size_t i = 0; i < bins; ++i) levels.push_back(low + (static_cast<double>(i) + 0.5) * step);
  }
  for (const double at : places.at) {
    const auto level = ranges ? static_cast<size_t>((at - low) / step)
                              : static_cast<size_t>(std::ranges::lower_bound(levels, at) - levels.begin());
    places.level.push_back(std::min(level, levels.size() - 1));
  }
  places.level_at = levels;
  for (const double level : levels) {
    places.level_words.push_back(fmt::format("{:.4g}", log ? std::pow(10.0, level) : level));
  }
  return places;
}

/// Mean of some points; none if there is no point, or a point lacks the figure.
std::optional<double> mean_of(const SweepAnalysis& analysis, const std::vector<size_t>& points) {
  double sum = 0.0;
  for (const size_t i : points) sum += analysis.figures[i].mean;
  const double mean = sum / static_cast<double>(points.size());
  return std::isfinite(mean) ? std::optional(mean) : std::nullopt;
}

std::vector<double> means(const std::vector<PointFigure>& figures) {
  std::vector<double> values;
  for (const PointFigure& figure : figures) values.push_back(figure.mean);
  return values;
}

FigureCanvas main_effects(const SweepAnalysis& analysis) {
  const size_t count = analysis.points.paths.size();
  FigureCanvas canvas(kWidth, kHeight * static_cast<double>(count));
  for (size_t p = 0; p < count; ++p) {
    const Places places = places_of(analysis, p);
    FigurePlot plot(canvas, {0.0, kHeight * static_cast<double>(p)}, kWidth, kHeight, places.axis,
                    FigureAxis::of_numbers(analysis.label(), means(analysis.figures)));
    std::vector<std::vector<size_t>> groups(places.level_at.size());
    for (size_t i = 0; i < places.at.size(); ++i) {
      groups[places.level[i]].push_back(i);
      if (std::isnan(analysis.figures[i].mean)) continue;
      canvas.circle(plot.at(places.at[i], analysis.figures[i].mean), 1.5, {.fill = kGrey, .stroke = ""});
    }
    std::vector<Point> line;
    for (size_t level = 0; level < groups.size(); ++level) {
      if (groups[level].empty()) continue;
      if (const auto mean = mean_of(analysis, groups[level])) line.push_back(plot.at(places.level_at[level], *mean));
    }
    canvas.line(line, {.fill = "", .stroke = kBlue, .width = 1.5});
    for (const Point& point : line) canvas.circle(point, 2.2, {.fill = kBlue, .stroke = ""});
  }
  return canvas;
}

/// Draws the colors from `low` to `high` with these numbers, top left.
void draw_scale(FigureCanvas& canvas, double low, double high, bool less) {
  constexpr double kShades = 16.0, kShade = 2.5, kTop = 3.0;
  const std::string first = fmt::format("{:.3g}", low);
  const double left = 8.0 + FigureCanvas::text_width(first, 7.0);
  canvas.text({4.0, 9.0}, first, 7.0);
  for (double k = 0.0; k < kShades; ++k) {
    const double share = k / (kShades - 1.0);
    canvas.rectangle({left + kShade * k, kTop}, kShade, 6.0,
                     {.fill = ramp_color(less ? 1.0 - share : share), .stroke = ""});
  }
  canvas.text({left + kShade * kShades + 4.0, 9.0}, fmt::format("{:.3g}", high), 7.0);
}

FigureCanvas heat_map(const SweepAnalysis& analysis, size_t across, size_t up) {
  FigureCanvas canvas(kWidth, 1.1 * kHeight);
  const Places x = places_of(analysis, across), y = places_of(analysis, up);
  const FigurePlot plot(canvas, {0.0, 0.0}, kWidth, 1.1 * kHeight, FigureAxis::of_words(x.axis.label, x.level_words),
                        FigureAxis::of_words(y.axis.label, y.level_words));
  std::map<std::pair<size_t, size_t>, std::vector<size_t>> cells;
  for (size_t i = 0; i < x.level.size(); ++i) cells[{x.level[i], y.level[i]}].push_back(i);
  double low = INFINITY, high = -INFINITY;
  for (const auto& [place, points] : cells) {
    const auto mean = mean_of(analysis, points);
    if (mean) low = std::min(low, *mean), high = std::max(high, *mean);
  }
  for (const auto& [place, points] : cells) {
    const auto mean = mean_of(analysis, points);
    if (!mean) continue;
    const auto cx = static_cast<double>(place.first), cy = static_cast<double>(place.second);
    const Point corner = plot.at(cx - 0.5, cy + 0.5), end = plot.at(cx + 0.5, cy - 0.5);
    const double share = high > low ? (*mean - low) / (high - low) : 0.5;
    const std::string color = ramp_color(analysis.less ? 1.0 - share : share);
    canvas.rectangle(corner, end.x - corner.x, end.y - corner.y, {.fill = color, .stroke = "#ffffff", .width = 0.5});
    const std::string words = fmt::format("{:.3g}", *mean);
    if (FigureCanvas::text_width(words, 6.5) > end.x - corner.x - 2.0) continue;
    canvas.text({0.5 * (corner.x + end.x), 0.5 * (corner.y + end.y) + 2.3}, words, 6.5, FigureCanvas::Anchor::center,
                false, is_dark(color) ? "#ffffff" : "#1b2330");
  }
  canvas.text({kWidth - 4.0, 9.0}, shortened("mean of " + analysis.label(), 150.0, 7.0), 7.0,
              FigureCanvas::Anchor::right);
  if (low <= high) draw_scale(canvas, low, high, analysis.less);
  return canvas;
}

FigureCanvas pareto(const SweepAnalysis& analysis, const std::string& other, const std::vector<PointFigure>& figures) {
  FigureCanvas canvas(kWidth, kHeight);
  const FigurePlot plot(canvas, {0.0, 0.0}, kWidth, kHeight,
                        FigureAxis::of_numbers(analysis.labels.at(other), means(figures)),
                        FigureAxis::of_numbers(analysis.label(), means(analysis.figures)));
  const std::vector<size_t> front = pareto_front(analysis, figures, !analysis.more_is_better.contains(other));
  for (size_t i = 0; i < figures.size(); ++i) {
    if (std::isnan(figures[i].mean) || std::isnan(analysis.figures[i].mean)) continue;
    canvas.circle(plot.at(figures[i].mean, analysis.figures[i].mean), 2.0,
                  {.fill = figures[i].none_failed() ? kBlue : kOrange, .stroke = ""});
  }
  std::vector<Point> steps;
  for (const size_t i : front) {
    const Point place = plot.at(figures[i].mean, analysis.figures[i].mean);
    if (!steps.empty()) steps.push_back({place.x, steps.back().y});
    steps.push_back(place);
    canvas.circle(place, 3.6, {.fill = "", .stroke = "#1b2330", .width = 1.0});
  }
  canvas.line(steps, {.fill = "", .stroke = "#1b2330", .width = 0.75, .dashed = true});
  return canvas;
}

FigureCanvas index_bars(const SweepAnalysis& analysis, const Json& indices) {
  const size_t count = analysis.points.paths.size();
  FigureCanvas canvas(kWidth, 46.0 + 26.0 * static_cast<double>(count));
  const double left = 96.0, width = kWidth - left - 12.0;
  for (size_t p = 0; p < count; ++p) {
    const double y = 20.0 + 26.0 * static_cast<double>(p);
    canvas.text({left - 5.0, y + 11.0}, shortened(analysis.points.paths[p], left - 10.0, 7.0), 7.0,
                FigureCanvas::Anchor::right);
    for (const size_t kind : {0U, 1U}) {
      const auto value = [&](size_t k) { return std::clamp(indices[p][3 * kind + k].get<double>(), 0.0, 1.0); };
      const double top = y + 10.0 * static_cast<double>(kind);
      canvas.rectangle({left, top}, width * value(0), 8.0, {.fill = kind == 0 ? kBlue : "#56b4e9", .stroke = ""});
      canvas.line({{left + width * value(1), top + 4.0}, {left + width * value(2), top + 4.0}},
                  {.fill = "", .stroke = "#1b2330", .width = 0.75});
    }
  }
  const double bottom = 20.0 + 26.0 * static_cast<double>(count);
  canvas.line({{left, bottom}, {left + width, bottom}}, {.fill = "", .stroke = kGrey});
  for (const double tick : {0.0, 0.5, 1.0}) {
    canvas.text({left + width * tick, bottom + 9.0}, fmt::format("{:g}", tick), 7.0, FigureCanvas::Anchor::center);
  }
  canvas.text({left + 0.5 * width, bottom + 20.0}, "share of the variance of " + shortened(analysis.column, 120.0, 7.0),
              7.0, FigureCanvas::Anchor::center);
  canvas.text({kWidth - 12.0, 10.0}, "dark: first-order index, light: total index", 7.0, FigureCanvas::Anchor::right);
  return canvas;
}

/// The column for the other axis of the Pareto front, as the page chooses it.
std::string second_column(const FlightList& flights, const SweepAnalysis& analysis) {
  std::vector<std::string> names = {"flight_time_s", "path_length_m", "metric.jerk_rms", "min_obstacle_clearance_m"};
  names.insert(names.end(), analysis.points.columns.begin(), analysis.points.columns.end());
  for (const std::string& name : names) {
    if (name == analysis.column || std::ranges::find(analysis.points.columns, name) == analysis.points.columns.end()) {
      continue;
    }
    if (varies(point_means(flights, analysis.points, name))) return name;
  }
  return "";
}

}  // namespace

std::vector<std::string> write_sweep_figures(const std::filesystem::path& folder, const std::filesystem::path& out,
                                             const std::string& column) {
  const FlightList flights = read_flights(folder);
  const Json data = sweep_data(folder, flights);
  if (data.is_null()) throw InputError(folder.string() + ": --figures is for sweeps");
  const SweepAnalysis analysis = analyze_sweep(folder, flights, column);
  create_folders(out);
  std::vector<std::string> files;
  const auto write = [&](const std::string& name, const std::string& text) {
    write_file_whole(out / name, text);
    files.push_back(name);
  };
  const auto draw = [&](const std::string& name, const FigureCanvas& canvas) {
    write(name + ".svg", canvas.svg());
    write(name + ".pdf", canvas.pdf());
  };
  write("ranking.csv", ranking_csv(flights, analysis));
  write("ranking.tex", ranking_latex(analysis));
  draw("main_effects", main_effects(analysis));
  std::vector<size_t> varied;
  for (size_t p = 0; p < analysis.points.paths.size(); ++p) {
    if (varies_in(analysis.points, p)) varied.push_back(p);
  }
  if (varied.size() > 1) draw("heat_map", heat_map(analysis, varied[0], varied[1]));
  if (const std::string other = second_column(flights, analysis); !other.empty()) {
    const auto figures = point_figures(flights, analysis.points, other);
    draw("pareto", pareto(analysis, other, figures));
    write("pareto.csv", pareto_csv(analysis, other, figures));
  }
  if (const Json& columns = data.at("effects").at("columns"); columns.contains(analysis.column)) {
    draw("indices", index_bars(analysis, columns.at(analysis.column)));
    write("indices.csv", indices_csv(analysis, data.at("effects")));
    write("indices.tex", indices_latex(analysis, data.at("effects")));
  }
  return files;
}

}  // namespace hedgehop::sim
