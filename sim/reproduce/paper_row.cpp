#include "sim/reproduce/paper_row.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "sim/batch/record.h"
#include "sim/config/numbers.h"
#include "sim/flight/build.h"
#include "sim/flight/words.h"
#include "sim/record/table.h"

namespace hedgehop::sim {
namespace {

/// Returns whether flights without the figure do not count; `missing` gives the reason.
bool excuses_missing(const PaperRow& row) {
  return row.missing != "fails" && parse_number(row.missing, false).kind != ParsedNumber::Kind::number;
}

/// Returns whether the row allows no contact. Its flights must also finish, because a hovering vehicle has no contact.
bool forbids_contact(const PaperRow& row) {
  return counts(row.statistic) && row.is == "collided" && row.column == "outcome" && row.at_most.has_value();
}

/// Returns whether a measured figure, or that of a variant, meets the requirement.
bool judged(const PaperRow& row, const MeasuredFigure& figure) {
  const double value = figure.value;
  if (!(value >= row.at_least.value_or(-INFINITY) && value <= row.at_most.value_or(INFINITY))) return false;
  if (!row.calculation.empty()) return true;
  if (forbids_contact(row) && figure.unfinished > 0) return false;
  return figure.all_flown() && (figure.complete() || excuses_missing(row));
}

/// Returns the figure with enough digits to distinguish it from its bound.
std::string measured_words(const PaperRow& row, const MeasuredFigure& figure) {
  const bool low = row.at_least && figure.value < *row.at_least;
  return figure_words(row, figure, low ? *row.at_least : row.at_most.value_or(NAN));
}

std::string command_of(const PaperRow& row, const Paper& paper) {
  if (!row.calculation.empty()) return "hedgehop reproduce " + shell_quoted(paper.key);
  std::string command;
  for (const FlightGroup& group : flight_groups(paper)) {
    if (std::ranges::find(row.flights, group.name) == row.flights.end()) continue;
    command += fmt::format("{}hedgehop batch {} --seeds {}", command.empty() ? "" : "; ", shell_quoted(group.scenario),
                           group.seeds);
    for (const std::string& text : group.set) command += " --set " + shell_quoted(text);
  }
  return command;
}

/// Returns the figure in the row's unit: shares become percent.
MeasuredFigure in_unit(const PaperRow& row, MeasuredFigure figure) {
  if (row.unit == "%") figure.value *= 100.0;
  return figure;
}

/// Returns the row's figure over a variant of its flights; empty if one of them has no such variant.
std::optional<MeasuredFigure> variant_figure(const PaperRow& row, const std::string& variant,
                                             const PaperOutcome& outcome) {
  FlightFigure figure = row;
  const std::vector<FlightGroup> groups = flight_groups(outcome.paper);
  for (std::string& name : figure.flights) {
    name += "/" + variant;
    if (std::ranges::find(groups, name, &FlightGroup::name) == groups.end()) return {};
  }
  return in_unit(row, measure(figure, outcome, row.missing));
}

RowOutcome row_outcome(const PaperRow& row, const PaperOutcome& outcome) {
  RowOutcome result{.row = row,
                    .modified = {},
                    .variants = {},
                    .holds = {},
                    .published_holds = {},
                    .command = command_of(row, outcome.paper)};
  if (row.calculation.empty()) {
    result.modified = in_unit(row, measure(row, outcome, row.missing));
    for (const char* variant : {"published", "ideal", "dull"}) {
      if (auto figure = variant_figure(row, variant, outcome)) result.variants[variant] = *std::move(figure);
    }
  } else {
    result.modified.value = outcome.calculations.at(row.calculation).at(row.value).back();
    result.modified.builds.insert(std::string(build_identity()));
  }
  result.builds = result.modified.builds;
  for (const auto& [variant, figure] : result.variants)
    result.builds.insert(figure.builds.begin(), figure.builds.end());
  const bool left_out = row.calculation.empty() && result.modified.required == 0;
  if ((row.at_least || row.at_most) && !left_out) result.holds = judged(row, result.modified);
  const auto published = result.variants.find("published");
  if (result.holds && published != result.variants.end()) result.published_holds = judged(row, published->second);
  return result;
}

}  // namespace

bool RowOutcome::measured() const {
  return !std::isnan(modified.value) || (row.calculation.empty() && modified.required == 0);
}

std::string RowOutcome::required_words() const {
  const bool of_flights = row.statistic == FlightFigure::Statistic::share && row.calculation.empty();
  const double scale = of_flights ? 100.0 : 1.0;
  const char* const unit = of_flights ? " %" : "";
  if (row.at_least && row.at_most)
    return fmt::format("{:g} to {:g}{}", scale * *row.at_least, scale * *row.at_most, unit);
  if (row.at_least) return fmt::format("at least {:g}{}", scale * *row.at_least, unit);
  return row.at_most ? fmt::format("at most {:g}{}", scale * *row.at_most, unit) : "-";
}

std::string RowOutcome::modified_words() const {
  if (row.calculation.empty() && modified.required == 0) return "not in the quick run";
  return measured_words(row, modified);
}

std::string RowOutcome::variant_words(const std::string& variant) const {
  const auto found = variants.find(variant);
  if (found == variants.end()) return "-";
  return found->second.required == 0 ? "not in the quick run" : measured_words(row, found->second);
}

std::string RowOutcome::flights_words() const {
  if (!row.calculation.empty()) return "-";
  std::string words =
      fmt::format("{}, {}, {}, {}", modified.required, modified.flown, modified.faulted, modified.with_figure);
  const size_t without = modified.flown - modified.faulted - modified.with_figure;
  if (without > 0 && excuses_missing(row)) words += fmt::format("; {} {}", without, row.missing);
  if (modified.stand_ins > 0) words += fmt::format("; {} without taken as {}", modified.stand_ins, row.missing);
  if (forbids_contact(row) && modified.unfinished > 0) words += fmt::format("; {} not finished", modified.unfinished);
  std::set<std::string> truth = modified.truth_used;
  for (const auto& [variant, figure] : variants) truth.insert(figure.truth_used.begin(), figure.truth_used.end());
  if (!truth.empty()) words += fmt::format("; truth used: {}", fmt::join(truth, ", "));
  return words;
}

std::string RowOutcome::interval_words() const {
  return modified.interval
             ? fmt::format("{:.0f} to {:.0f} %", 100.0 * modified.interval->low, 100.0 * modified.interval->high)
             : "-";
}

std::string RowOutcome::holds_words() const { return holds ? (*holds ? "yes" : "no") : "-"; }

std::vector<RowOutcome> row_outcomes(const PaperOutcome& outcome) {
  std::vector<RowOutcome> rows;
  for (const PaperRow& row : outcome.paper.rows) rows.push_back(row_outcome(row, outcome));
  return rows;
}

bool all_hold(const std::vector<RowOutcome>& rows) {
  return std::ranges::all_of(rows, [](const RowOutcome& row) { return row.measured() && row.holds.value_or(true); });
}

std::string rows_text(const Paper& paper, const std::vector<RowOutcome>& rows) {
  std::string text = fmt::format(
      "## {} [{}]\n\n| claim | paper | required | published | modified: ideal | modified: day | modified: dull | "
      "flights: "
      "required, flown, faulted, with figure | 95 % interval | holds | build | command "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      paper.title, paper.source);
  for (const RowOutcome& row : rows) {
    const std::string unit = row.row.unit.empty() ? "" : ", " + row.row.unit;
    text +=
        fmt::format("| {}{} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | `{}` |\n", row.row.claim, unit,
                    row.row.paper.empty() ? "-" : row.row.paper, row.required_words(), row.variant_words("published"),
                    row.variant_words("ideal"), row.modified_words(), row.variant_words("dull"), row.flights_words(),
                    row.interval_words(), row.holds == false ? "**no**" : row.holds_words(),
                    row.builds.empty() ? "-" : fmt::format("{}", fmt::join(row.builds, ", ")), row.command);
  }
  if (!paper.moved_on.empty()) text += fmt::format("\nChange of judging seeds: {}\n", paper.moved_on);
  if (!paper.deviations.empty()) text += "\nDeviations of the published law from the paper:\n\n";
  for (const std::string& deviation : paper.deviations) text += fmt::format("- {}\n", deviation);
  return text;
}

std::string rows_csv(const RowsOfPapers& papers) {
  fmt::memory_buffer out;
  {
    CsvLine header(out);
    for (const char* name : {"paper",      "claim",  "unit",    "in_paper", "at_least",   "at_most", "as_published",
                             "ideal",      "day",    "dull",    "required", "flown",      "faulted", "with_figure",
                             "unfinished", "low_95", "high_95", "holds",    "truth_used", "build",   "command"}) {
      header.add(std::string_view(name));
    }
  }
  for (const auto& [paper, rows] : papers) {
    for (const RowOutcome& row : rows) {
      const auto variant = [&](const char* name) {
        const auto found = row.variants.find(name);
        return found == row.variants.end() ? std::nullopt : std::optional(found->second.value);
      };
      const auto& interval = row.modified.interval;
      CsvLine line(out);
      for (const std::string& text : {paper.key, row.row.claim, row.row.unit, row.row.paper}) line.add(text);
      line.add(row.row.at_least).add(row.row.at_most).add(variant("published")).add(variant("ideal"));
      line.add(row.modified.value).add(variant("dull"));
      for (const size_t count : {row.modified.required, row.modified.flown, row.modified.faulted,
                                 row.modified.with_figure, row.modified.unfinished}) {
        line.add(std::to_string(count));
      }
      line.add(interval ? std::optional(interval->low) : std::nullopt);
      line.add(interval ? std::optional(interval->high) : std::nullopt);
      line.add(row.holds ? row.holds_words() : "").add(fmt::format("{}", fmt::join(row.modified.truth_used, "; ")));
      line.add(fmt::format("{}", fmt::join(row.builds, "; "))).add(row.command);
    }
  }
  return fmt::to_string(out);
}

}  // namespace hedgehop::sim
