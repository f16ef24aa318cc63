#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/fields/field.h"

/// Re-simulation of a paper's experiments, and comparison with its figures.
namespace hedgehop::sim {

/// Flights of one scenario that differ by the seed only, and the same flights with the published law or other sensors.
struct PaperFlights {
  std::string name;      ///< used by rows and charts; after reading, the default is the scenario file's name
  std::string scenario;  ///< relative to the paper's file; after reading, to the working folder
  std::string seeds;
  std::optional<std::string> tuned_on;  ///< default: the paper's
  std::optional<std::string> quick;     ///< seeds of a quick run; empty: not part of it
  std::vector<std::string> set;
  std::vector<std::string> published;
  std::optional<std::string> published_seeds;
  std::vector<std::string> sensors;
  std::optional<std::string> sensor_seeds;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PaperFlights> auto& c) {
  v("name", c.name, {.meaning = "name used by rows and charts; default: the scenario file's name"});
  v("scenario", c.scenario, {.required = true, .meaning = "scenario file, relative to this file"});
  v("seeds", c.seeds,
    {.required = true, .meaning = "seeds such as 1001:1030 or 1001:1003,1007, without seeds of tuned_on"});
  v("tuned_on", c.tuned_on, {.meaning = "tuning seeds of this entry; default: the file's"});
  v("quick", c.quick, {.meaning = "subset of the seeds that --quick flies; default: no seeds"});
  v("set", c.set, {.meaning = "overrides of the scenario, each key.path=value"});
  v("published", c.published, {.meaning = "further overrides for the published law; named NAME/published"});
  v("published_seeds", c.published_seeds,
    {.meaning = "subset of the seeds flown with the published law; default: all seeds"});
  v("sensors", c.sensors,
    {.meaning = "ideal, dull: additional flights with ../sensors/ideal.yaml, dull.yaml, named NAME/ideal, NAME/dull"});
  v("sensor_seeds", c.sensor_seeds, {.meaning = "subset of the seeds flown with those sensors; default: all seeds"});
}

/// A statistic of a column of a campaign's table over flights.
struct FlightFigure {
  enum class Statistic { count, share, min, max, mean, median };
  std::vector<std::string> flights;
  std::string column;
  std::string is;
  Statistic statistic = Statistic::mean;
};
/// Returns whether the statistic counts the flights with a given value of the column.
bool counts(FlightFigure::Statistic statistic);
template <class Visitor>
void describe_figure(Visitor& v, fields::ConfigOf<FlightFigure> auto& c) {
  v("flights", c.flights, {.meaning = "names of flights"});
  v("column", c.column, {.meaning = "column of a batch's table, such as outcome, min_clearance_m or metric.jerk_rms"});
  v("is", c.is, {.meaning = "for count and share: counted value of the column, such as collided"});
  v("statistic", c.statistic,
    {.choices = {"count", "share", "min", "max", "mean", "median"},
     .meaning = "statistic over the flights that have the column"});
}

/// One figure of the paper with the measured one.
struct PaperRow : FlightFigure {
  std::string claim, paper, unit;
  std::optional<double> at_least, at_most;  ///< bounds of the measured figure
  std::string missing = "fails";            ///< meaning of a flight without the figure
  std::string calculation, value;           ///< instead of flights
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PaperRow> auto& c) {
  v("claim", c.claim, {.required = true, .meaning = "claim of the row"});
  v("paper", c.paper, {.meaning = "figure in the paper"});
  v("unit", c.unit, {.meaning = "unit of the measured figure and its bounds; '%' for a column of shares"});
  v("at_least", c.at_least, {.meaning = "minimum of the measured figure"});
  v("at_most", c.at_most, {.meaning = "maximum of the measured figure"});
  describe_figure(v, fields::base<FlightFigure>(c));
  v("missing", c.missing,
    {.meaning =
         "meaning of a flight without the figure: 'fails'; a number that replaces the figure; or the reason that "
         "the flight does not count, such as 'met no collision course'"});
  v("calculation", c.calculation, {.meaning = "name of a calculation that needs no flight"});
  v("value", c.value, {.meaning = "column of the calculation; its last row counts"});
}

/// Points published in the paper.
struct PrintedSeries {
  static constexpr std::string_view kName = "points";
  static constexpr std::string_view kMeaning = "points listed here, from the paper";
  std::string label;
  std::vector<double> x, y;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PrintedSeries> auto& c) {
  v("label", c.label, {.required = true, .meaning = "in the legend"});
  v("x", c.x, {.required = true, .meaning = "on the horizontal axis"});
  v("y", c.y, {.required = true, .meaning = "on the vertical axis, as many as x"});
}

/// One point per group of flights.
struct GroupSeries : FlightFigure {
  static constexpr std::string_view kName = "groups";
  static constexpr std::string_view kMeaning = "a statistic of each group of flights";
  std::string label;
  std::vector<double> x;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<GroupSeries> auto& c) {
  v("label", c.label, {.required = true, .meaning = "in the legend"});
  v("x", c.x, {.required = true, .meaning = "on the horizontal axis, one for each group of flights"});
  describe_figure(v, fields::base<FlightFigure>(c));
}

/// Two columns of the log of each flight of a group.
struct LogSeries {
  enum class File { trajectory, decisions };
  static constexpr std::string_view kName = "log";
  static constexpr std::string_view kMeaning = "two columns of each flight's trajectory.csv or decisions.csv";
  std::string label, flights;
  File file = File::decisions;
  std::string x = "t_s", y;
  std::optional<uint64_t> seed;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LogSeries> auto& c) {
  v("label", c.label, {.required = true, .meaning = "in the legend"});
  v("flights", c.flights, {.required = true, .meaning = "name of flights"});
  v("file", c.file, {.choices = {"trajectory", "decisions"}, .meaning = "which log"});
  v("x", c.x, {.meaning = "its column on the horizontal axis"});
  v("y", c.y, {.required = true, .meaning = "its column on the vertical axis"});
  v("seed", c.seed, {.meaning = "of one flight; else all are drawn"});
}

/// Paths seen from above, over the scene of the first.
struct PathSeries {
  static constexpr std::string_view kName = "paths";
  static constexpr std::string_view kMeaning = "flown paths over the scene, seen from above";
  std::string label, flights;
  std::optional<uint64_t> seed;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PathSeries> auto& c) {
  v("label", c.label, {.required = true, .meaning = "in the legend"});
  v("flights", c.flights, {.required = true, .meaning = "name of flights"});
  v("seed", c.seed, {.meaning = "of one flight; else all are drawn"});
}

/// Two columns of a calculation.
struct CalculationSeries {
  static constexpr std::string_view kName = "calculation";
  static constexpr std::string_view kMeaning = "two columns of a calculation that needs no flight";
  std::string label, calculation, x, y;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<CalculationSeries> auto& c) {
  v("label", c.label, {.required = true, .meaning = "in the legend"});
  v("calculation", c.calculation, {.required = true, .meaning = "its name"});
  v("x", c.x, {.required = true, .meaning = "its column on the horizontal axis"});
  v("y", c.y, {.required = true, .meaning = "its column on the vertical axis"});
}

using PaperSeries = std::variant<PrintedSeries, GroupSeries, LogSeries, PathSeries, CalculationSeries>;

/// A figure of the paper, drawn from Hedgehop's flights.
struct PaperChart {
  enum class Scale { linear, log };
  std::string title, note, x, y;
  Scale x_scale = Scale::linear, y_scale = Scale::linear;
  std::vector<PaperSeries> series;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PaperChart> auto& c) {
  v("title", c.title, {.required = true, .meaning = "such as 'Fig. 13: ...'"});
  v("note", c.note, {.meaning = "caption"});
  v("x", c.x, {.meaning = "name and unit of the horizontal axis; not of paths"});
  v("y", c.y, {.meaning = "name and unit of the vertical axis; not of paths"});
  v("x_scale", c.x_scale, {.choices = {"linear", "log"}, .meaning = "of the horizontal axis"});
  v("y_scale", c.y_scale, {.choices = {"linear", "log"}, .meaning = "of the vertical axis"});
  v("series", c.series,
    {.required = true, .selector = "from", .meaning = "drawn series; paths cannot be combined with other series"});
}

/// All that `hedgehop reproduce` does for one paper.
struct Paper {
  std::string key;               ///< name of its file
  std::filesystem::path folder;  ///< of its file
  std::string title, source;
  std::optional<std::string> tuned_on;
  std::string moved_on;
  std::vector<std::string> deviations;
  std::vector<PaperFlights> flights;
  std::vector<PaperRow> rows;
  std::vector<PaperChart> charts;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<Paper> auto& c) {
  v("title", c.title, {.required = true, .meaning = "authors, year and subject"});
  v("source", c.source, {.required = true, .meaning = "key in REFERENCES.md"});
  v("tuned_on", c.tuned_on, {.meaning = "seeds that parameters were chosen on, such as 1:100, or none; must be given"});
  v("moved_on", c.moved_on, {.meaning = "reason for a change of the judging seeds"});
  v("deviations", c.deviations, {.meaning = "deviations of the published law from the paper, one text each"});
  v("flights", c.flights, {.meaning = "flights"});
  v("rows", c.rows, {.meaning = "the paper's figures with the measured ones"});
  v("charts", c.charts, {.meaning = "charts of the paper, drawn from Hedgehop's flights"});
}

/// Flights with one name that differ by the seed only: an entry's own, or a variant of them.
struct FlightGroup {
  std::string name, scenario, seeds;
  std::optional<std::string> quick;  ///< empty: not part of a quick run
  std::vector<std::string> set;
};

/// Returns the flights of a paper: each entry's own, then those with the published law, then those with other sensors.
std::vector<FlightGroup> flight_groups(const Paper& paper);

/// Reads a paper's file. Throws InputError with every fault: of the file, unknown names of flights or calculations,
/// rows without a source, invalid seeds, seeds that parameters were chosen on, series of unequal length, and charts
/// that mix paths with other series.
Paper read_paper(const std::filesystem::path& file);

}  // namespace hedgehop::sim
