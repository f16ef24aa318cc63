#include "sim/pages/reproduction_page.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/config/utf8.h"
#include "sim/flight/json_reader.h"
#include "sim/pages/decimate.h"
#include "sim/pages/flight_maps.h"
#include "sim/pages/plan.h"
#include "sim/pages/report_page.h"
#include "sim/record/table.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kMaxPointsOfLine = 600;  // per line: more than the pixels of a chart

Json line_data(const std::string& label, bool printed, const std::vector<double>& x, const std::vector<double>& y) {
  Json line{{"label", label}, {"printed", printed}, {"x", Json::array()}, {"y", Json::array()}};
  for (const double value : x) line["x"].push_back(brief(value));
  for (const double value : y) line["y"].push_back(brief(value));
  return line;
}

/// Returns the flights of a series: all, or those of one seed.
std::vector<FlightRecord> flights_of(const PaperOutcome& outcome, const std::string& name,
                                     std::optional<uint64_t> seed) {
  std::vector<FlightRecord> chosen;
  const auto found = outcome.flights.find(name);
  if (found == outcome.flights.end()) return chosen;
  std::ranges::copy_if(found->second, std::back_inserter(chosen),
                       [&](const FlightRecord& record) { return !seed || record.order.seed == *seed; });
  return chosen;
}

/// Adds the lines of a series to a chart.
class LineMaker {
 public:
  LineMaker(const PaperOutcome& outcome, Json& lines) : outcome_(outcome), lines_(lines) {}

  void operator()(const PrintedSeries& series) { lines_.push_back(line_data(series.label, true, series.x, series.y)); }

  void operator()(const GroupSeries& series) {
    std::vector<double> y;
    for (const std::string& name : series.flights) {
      FlightFigure figure = series;
      figure.flights = {name};
      const MeasuredFigure measured = measure(figure, outcome_);
      y.push_back(measured.complete() ? measured.value : NAN);  // the value of only some flights would be biased
    }
    lines_.push_back(line_data(series.label, false, series.x, y));
  }

  void operator()(const LogSeries& series) {
    const bool decisions = series.file == LogSeries::File::decisions;
    for (const FlightRecord& flight : flights_of(outcome_, series.flights, series.seed)) {
      const auto file = outcome_.folder / flight.order.id / (decisions ? "decisions.csv" : "trajectory.csv");
      try {
        const Table log(file);
        const std::vector<std::vector<double>> columns{log.numbers(series.x), log.numbers(series.y)};
        std::vector<double> x, y;
        for (const size_t row : decimate(columns, kMaxPointsOfLine)) {
          x.push_back(columns[0][row]);
          y.push_back(columns[1][row]);
        }
        lines_.push_back(line_data(series.label, false, x, y));
      } catch (const std::runtime_error&) {  // a flight without a log has no line
        continue;
      }
    }
  }

  void operator()(const PathSeries&) {}  // drawn on a map

  void operator()(const CalculationSeries& series) {
    const Columns& columns = outcome_.calculations.at(series.calculation);
    lines_.push_back(line_data(series.label, false, columns.at(series.x), columns.at(series.y)));
  }

 private:
  const PaperOutcome& outcome_;
  Json& lines_;
};

/// Returns paths over the scene of the first flight, each with the number of its series.
Json paths_of(const PaperChart& chart, const PaperOutcome& outcome) {
  std::vector<std::optional<FlownPath>> paths;
  Json labels = Json::array(), series_of = Json::array(), outcomes = Json::array();
  for (const PaperSeries& series : chart.series) {
    const auto* drawn = std::get_if<PathSeries>(&series);
    if (!drawn) continue;
    labels.push_back(drawn->label);
    for (const FlightRecord& flight : flights_of(outcome, drawn->flights, drawn->seed)) {
      auto path = read_path(outcome.folder / flight.order.id, flight.order.seed, kMaxPointsOfLine);
      if (!path) continue;
      paths.push_back(std::move(path));
      series_of.push_back(labels.size() - 1);
      outcomes.push_back(outcome_words(flight));
    }
  }
  if (labels.empty()) return nullptr;
  Json data = paths_data(flight_maps(paths), paths);
  data["labels"] = labels;
  data["series"] = series_of;
  data["outcome"] = outcomes;
  return data;
}

Json chart_data(const PaperChart& chart, const PaperOutcome& outcome) {
  Json json{{"title", chart.title},
            {"note", chart.note},
            {"x", chart.x},
            {"y", chart.y},
            {"log_x", chart.x_scale == PaperChart::Scale::log},
            {"log_y", chart.y_scale == PaperChart::Scale::log},
            {"lines", Json::array()}};
  LineMaker maker(outcome, json["lines"]);
  for (const PaperSeries& series : chart.series) std::visit(maker, series);
  json["paths"] = paths_of(chart, outcome);
  return json;
}

}  // namespace

Json paper_data(const PaperOutcome& outcome, const std::vector<RowOutcome>& rows) {
  Json json{{"key", outcome.paper.key},
            {"title", outcome.paper.title},
            {"source", outcome.paper.source},
            {"moved_on", outcome.paper.moved_on},
            {"deviations", outcome.paper.deviations},
            {"rows", Json::array()},
            {"charts", Json::array()}};
  for (const RowOutcome& row : rows) {
    json["rows"].push_back(Json{{"claim", row.row.claim},
                                {"unit", row.row.unit},
                                {"paper", row.row.paper},
                                {"required", row.required_words()},
                                {"published", row.variant_words("published")},
                                {"published_holds", row.published_holds ? Json(*row.published_holds) : Json(nullptr)},
                                {"ideal", row.variant_words("ideal")},
                                {"day", row.modified_words()},
                                {"dull", row.variant_words("dull")},
                                {"flights", row.flights_words()},
                                {"interval", row.interval_words()},
                                {"holds", row.holds ? Json(*row.holds) : Json(nullptr)},
                                {"build", row.builds},
                                {"command", row.command}});
  }
  for (const PaperChart& chart : outcome.paper.charts) json["charts"].push_back(chart_data(chart, outcome));
  return json;
}

std::string reproduction_page(const Json& papers, const PageFacts& facts) {
  const Json data{{"version", facts.version}, {"build", facts.build + of_commit(facts)},
                  {"builds", facts.builds},   {"packages", package_words(facts)},
                  {"quick", facts.quick},     {"papers", papers}};
  return reproduction_html("Papers reproduced", json_text(data));
}

}  // namespace hedgehop::sim
