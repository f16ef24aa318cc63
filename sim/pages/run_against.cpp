#include "sim/pages/run_against.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "sim/config/whole_file.h"
#include "sim/flight/json_reader.h"
#include "sim/flight/words.h"
#include "sim/pages/campaign_changes.h"
#include "sim/pages/decimate.h"
#include "sim/pages/report.h"
#include "sim/pages/report_page.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kMaxPlotTimes = 3'000, kMaxPathPoints = 4'000;
constexpr uintmax_t kMaxOtherFilmBytes = 40'000'000;

/// The first row in which a column differs.
struct Difference {
  double t_s = 0.0;
  std::string column, own, other;
};

/// Columns of both tables are compared as texts, which are exact. The first column that differs is named.
std::optional<Difference> first_difference(const Table& own, const Table& other) {
  const size_t rows = std::min(own.rows(), other.rows());
  const std::vector<double> t_s = own.numbers("t_s");
  std::optional<Difference> first;
  size_t first_row = rows;
  for (const std::string& name : own.names()) {
    if (!other.has(name) || name.ends_with("_ms")) continue;
    const std::vector<std::string> a = own.words(name), b = other.words(name);
    for (size_t row = 0; row < first_row; ++row) {
      if (a[row] == b[row]) continue;
      first_row = row;
      first = Difference{t_s[row], name, a[row], b[row]};
    }
  }
  return first;
}

/// Returns both values; numbers with as many figures as distinguish them.
std::pair<std::string, std::string> shown_pair(const std::string& own, const std::string& other) {
  char *own_end = nullptr, *other_end = nullptr;
  const double a = std::strtod(own.c_str(), &own_end), b = std::strtod(other.c_str(), &other_end);
  const bool numbers = !own.empty() && !other.empty() && *own_end == '\0' && *other_end == '\0';
  if (numbers && a != b) return {distinct_figures(a, b), distinct_figures(b, a)};
  const auto shown = [](const std::string& text) { return text.empty() ? "no value" : text; };
  return {shown(own), shown(other)};
}

std::string words_of(const Difference& difference, std::string_view what) {
  const auto [own, other] = shown_pair(difference.own, difference.other);
  return fmt::format("{} at {:.3f} s: column {} is {} here, {} in the other run", what, difference.t_s,
                     difference.column, own, other);
}

/// Returns lines that name the first difference of the decisions and of the flight.
Json first_lines(const RunRecord& own, const RunRecord& other) {
  if (own.result.flight.trajectory_hash == other.result.flight.trajectory_hash) {
    return Json::array({"The trajectories are equal, bit for bit."});
  }
  Json lines = Json::array();
  const auto decision = first_difference(own.decisions, other.decisions);
  const auto motion = first_difference(own.trajectory, other.trajectory);
  if (decision && (!motion || decision->t_s <= motion->t_s))
    lines.push_back(words_of(*decision, "First decision that differs"));
  if (motion) lines.push_back(words_of(*motion, "First row of the flight that differs"));
  if (decision && motion && decision->t_s > motion->t_s) {
    lines.push_back(words_of(*decision, "First decision that differs"));
  }
  if (lines.empty()) {
    lines.push_back(fmt::format("Equal until {:.3f} s, when the shorter flight ends.",
                                std::min(own.result.flight.flight_time_s, other.result.flight.flight_time_s)));
  }
  return lines;
}

/// Values at given times: those of the last row before each time; NaN after the end.
std::vector<double> at_times(const std::vector<double>& t_s, const std::vector<double>& values,
                             const std::vector<double>& times_s) {
  constexpr double kTick = 1e-9;
  std::vector<double> sampled;
  for (const double time : times_s) {
    const auto next = std::ranges::upper_bound(t_s, time + kTick);
    const bool inside = next != t_s.begin() && time <= t_s.back() + kTick;
    sampled.push_back(inside ? values[static_cast<size_t>(next - t_s.begin()) - 1] : NAN);
  }
  return sampled;
}

}  // namespace

std::vector<Panel> overlaid_panels(const std::vector<Panel>& own, const std::vector<Panel>& other) {
  std::vector<Panel> panels;
  for (const Panel& panel : own) {
    const auto twin = std::ranges::find_if(
        other, [&](const Panel& p) { return p.section == panel.section && p.title == panel.title; });
    if (twin == other.end() || panel.t_s.empty() || twin->t_s.empty()) continue;
    const double end_s = std::max(panel.t_s.back(), twin->t_s.back());
    const size_t count = std::clamp<size_t>(std::max(panel.t_s.size(), twin->t_s.size()), 2, kMaxPlotTimes);
    Panel both = panel;
    both.t_s.clear();
    both.series.clear();
    for (size_t i = 0; i < count; ++i)
      both.t_s.push_back(end_s * static_cast<double>(i) / static_cast<double>(count - 1));
    for (const Series& series : panel.series) {
      // Estimates would hide the comparison.
      const auto match = std::ranges::find(twin->series, series.label, &Series::label);
      if (series.role == "est" || match == twin->series.end()) continue;
      both.series.push_back({series.label, series.role, at_times(panel.t_s, series.values, both.t_s)});
      both.series.push_back({series.label + ", other run", series.role, at_times(twin->t_s, match->values, both.t_s)});
    }
    if (!both.series.empty()) panels.push_back(std::move(both));
  }
  return panels;
}

Json run_against_data(const std::filesystem::path& folder, const RunRecord& run,
                      const std::filesystem::path& other_folder, const RunRecord& other) {
  Json data{{"name", other_folder.string()},
            {"result", page_result(other.result)},
            {"first", first_lines(run, other)},
            {"settings", setting_changes(run.scenario_yaml, other.scenario_yaml)}};
  const std::vector<double> north = other.trajectory.numbers("north_m"), east = other.trajectory.numbers("east_m");
  Json n = Json::array(), e = Json::array();
  for (const size_t row : decimate(std::vector<std::vector<double>>{north, east}, kMaxPathPoints)) {
    n.push_back(milli(north[row]));
    e.push_back(milli(east[row]));
  }
  data["path"] = {{"n", std::move(n)}, {"e", std::move(e)}};
  data["film"] = nullptr;
  const std::filesystem::path film = other_folder / "video.webm";
  std::error_code missing;
  const uintmax_t bytes = std::filesystem::file_size(film, missing);
  if (!missing && bytes > 0) {
    data["film"] =
        bytes > kMaxOtherFilmBytes
            ? Json{{"link",
                    std::filesystem::absolute(film).lexically_relative(std::filesystem::absolute(folder)).string()}}
            : Json{{"bytes", base64(read_file_whole(film))}};
  }
  return data;
}

}  // namespace hedgehop::sim
