#include "sim/pages/figure_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace hedgehop::sim {
namespace {

constexpr double kTextSize = 7.0;
constexpr double kMaxTickWidth = 70.0;  // "-1.00000000005e+17"
constexpr std::array<std::array<double, 3>, 4> kRamp = {
    {{0xc8, 0x42, 0x0a}, {0xe6, 0x9f, 0x00}, {0x56, 0xb4, 0xe9}, {0x0a, 0x5f, 0xa0}}};

/// Returns different numbers with the same number of significant figures: `figures`, or more if words would be equal.
std::vector<std::string> distinct_words(const std::vector<double>& values, int figures) {
  const size_t different = std::set<double>(values.begin(), values.end()).size();
  for (;; ++figures) {
    std::vector<std::string> words;
    for (const double value : values) words.push_back(fmt::format("{:.{}g}", value, figures));
    const size_t distinct = std::set<std::string>(words.begin(), words.end()).size();
    if (distinct == different || figures >= std::numeric_limits<double>::max_digits10) return words;
  }
}

/// Returns round numbers in a range, about five and at most six.
std::vector<FigureAxis::Tick> round_ticks(double low, double high) {
  constexpr double kMaxSteps = 5.0;
  const double rough = (high - low) / kMaxSteps, power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= rough) step = factor * power;
  }
  std::vector<double> values;
  const double first = std::ceil(low / step), last = std::min(std::floor(high / step + 1e-9) - first, kMaxSteps);
  for (double k = 0.0; k <= last; ++k) {  // first + k may equal first: the count ends the loop
    values.push_back(first + k == 0.0 ? 0.0 : (first + k) * step);
  }
  const std::vector<std::string> words = distinct_words(values, 6);
  std::vector<FigureAxis::Tick> ticks;
  for (size_t i = 0; i < values.size(); ++i) ticks.push_back({values[i], words[i]});
  return ticks;
}

}  // namespace

FigureAxis FigureAxis::of_numbers(const std::string& label, const std::vector<double>& values) {
  double low = INFINITY, high = -INFINITY;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (!(low <= high)) low = 0.0, high = 1.0;
  // Ticks differ only if the range is wide enough.
  const double middle = low / 2.0 + high / 2.0, least = 1e-9 * std::max(1.0, std::abs(middle));
  if (high - low < least) {
    const double half = low == high ? std::max(0.5, least) : least / 2.0;
    low = middle - half, high = middle + half;
  }
  const double pad = 0.05 * (high - low);
  return {.label = label, .low = low - pad, .high = high + pad, .ticks = round_ticks(low - pad, high + pad)};
}

FigureAxis FigureAxis::of_logarithms(const std::string& label, std::vector<double> values) {
  constexpr size_t kMaxTicks = 8, kQuarters = 4;
  std::ranges::sort(values);
  values.erase(std::ranges::unique(values).begin(), values.end());
  std::vector<double> logarithms(values.size());
  std::ranges::transform(values, logarithms.begin(), [](double value) { return std::log10(value); });
  FigureAxis axis = of_numbers(label, logarithms);
  axis.ticks.clear();
  const size_t parts = values.size() <= kMaxTicks ? values.size() - 1 : kQuarters;
  std::vector<double> shown;
  for (size_t k = 0; k <= parts; ++k) {
    const size_t i = parts == 0 ? 0 : (k * (values.size() - 1) + parts / 2) / parts;
    shown.push_back(values[i]);
    axis.ticks.push_back({logarithms[i], ""});
  }
  const std::vector<std::string> words = distinct_words(shown, 3);
  for (size_t k = 0; k < words.size(); ++k) axis.ticks[k].words = words[k];
  return axis;
}

FigureAxis FigureAxis::of_words(const std::string& label, const std::vector<std::string>& words) {
  FigureAxis axis{.label = label, .low = -0.5, .high = static_cast<double>(words.size()) - 0.5, .ticks = {}};
  for (size_t i = 0; i < words.size(); ++i) axis.ticks.push_back({static_cast<double>(i), words[i]});
  return axis;
}

FigurePlot::FigurePlot(FigureCanvas& canvas, FigureCanvas::Point corner, double width, double height, FigureAxis x,
                       FigureAxis y)
    : x_(std::move(x)), y_(std::move(y)) {
  double left = 0.0;
  for (const FigureAxis::Tick& tick : y_.ticks) {
    left = std::max(left, std::min(kMaxTickWidth, FigureCanvas::text_width(tick.words, kTextSize)));
  }
  left += 20.0;
  corner_ = {corner.x + left, corner.y + 14.0};
  width_ = width - left - 10.0;
  height_ = height - 14.0 - 30.0;
  const FigureCanvas::Style frame{.fill = "", .stroke = "#8d97a6", .width = 0.75};
  const double bottom = corner_.y + height_;
  double last_end = -INFINITY;
  for (const FigureAxis::Tick& tick : x_.ticks) {
    const double place = at(tick.value, y_.low).x;
    const std::string words = shortened(tick.words, kMaxTickWidth, kTextSize);
    const double half = 0.5 * FigureCanvas::text_width(words, kTextSize);
    canvas.line({{place, bottom}, {place, bottom + 2.5}}, frame);
    if (place - half < last_end + 3.0) continue;
    last_end = place + half;
    canvas.text({place, bottom + 10.0}, words, kTextSize, FigureCanvas::Anchor::center);
  }
  for (const FigureAxis::Tick& tick : y_.ticks) {
    const double place = at(x_.low, tick.value).y;
    canvas.line({{corner_.x - 2.5, place}, {corner_.x, place}}, frame);
    canvas.text({corner_.x - 4.0, place + 2.5}, shortened(tick.words, kMaxTickWidth, kTextSize), kTextSize,
                FigureCanvas::Anchor::right);
  }
  canvas.rectangle(corner_, width_, height_, frame);
  canvas.text({corner_.x + 0.5 * width_, bottom + 22.0}, shortened(x_.label, width_, kTextSize), kTextSize,
              FigureCanvas::Anchor::center);
  canvas.text({corner.x + 8.0, corner_.y + 0.5 * height_}, shortened(y_.label, height_, kTextSize), kTextSize,
              FigureCanvas::Anchor::center, true);
}

FigureCanvas::Point FigurePlot::at(double x, double y) const {
  return {corner_.x + (x - x_.low) / (x_.high - x_.low) * width_,
          corner_.y + height_ - (y - y_.low) / (y_.high - y_.low) * height_};
}

std::string shortened(std::string_view words, double width, double size) {
  if (FigureCanvas::text_width(words, size) <= width) return std::string(words);
  std::string text(words);
  while (!text.empty() && FigureCanvas::text_width(text + "...", size) > width) text.pop_back();
  return text + "...";
}

std::string ramp_color(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(kRamp.size() - 1);
  const size_t i = std::min(static_cast<size_t>(place), kRamp.size() - 2);
  const double part = place - static_cast<double>(i);
  std::string color = "#";
  for (size_t k = 0; k < 3; ++k) {
    color += fmt::format("{:02x}", static_cast<int>(std::lround(kRamp[i][k] + part * (kRamp[i + 1][k] - kRamp[i][k]))));
  }
  return color;
}

bool is_dark(std::string_view color) {
  constexpr std::array<double, 3> kWeights = {0.3, 0.59, 0.11};  // of red, green and blue for brightness
  double brightness = 0.0;
  for (size_t k = 0; k < 3; ++k) {
    int part = 0;
    std::from_chars(color.data() + 1 + 2 * k, color.data() + 3 + 2 * k, part, 16);
    brightness += kWeights[k] * part;
  }
  return brightness < 140.0;
}

}  // namespace hedgehop::sim
