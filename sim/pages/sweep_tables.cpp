#include "sim/pages/sweep_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/batch/record.h"
#include "sim/config/numbers.h"
#include "sim/record/table.h"

namespace hedgehop::sim {
namespace {

using Words = std::vector<std::string>;

/// Returns text for LaTeX.
std::string latex(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (std::string_view("&%$#_{}").find(c) != std::string_view::npos) out += '\\';
    out += c == '\\'  ? "\\textbackslash{}"
           : c == '~' ? "\\textasciitilde{}"
           : c == '^' ? "\\textasciicircum{}"
                      : std::string(1, c);
  }
  return out;
}

/// Returns the text of a number with a minus instead of a hyphen; a zero has no sign.
std::string with_minus(const std::string& text) {
  if (!text.starts_with('-')) return text;
  const std::string digits = text.substr(1);
  return digits.find_first_of("123456789") == std::string::npos ? digits : "$-$" + digits;
}

std::string latex_number(double value, int figures = 4) {
  return std::isnan(value) ? "--" : with_minus(fmt::format("{:.{}g}", value, figures));
}

std::string latex_value(const std::string& value) {
  return parse_number(value, false).kind == ParsedNumber::Kind::number ? with_minus(value) : latex(value);
}

/// Returns "2 of 3" with the numbers of flights without checks and not flown, or "no checks", "not flown".
std::string passed_words(const PointFigure& figure) {
  if (figure.missing == figure.flights) return "not flown";
  if (figure.unchecked == figure.flights) return std::string(kNoChecks);
  std::string words = fmt::format("{} of {}", figure.passed, figure.flights);
  if (figure.unchecked > 0) words += fmt::format("; {}: {}", kNoChecks, figure.unchecked);
  return figure.missing == 0 ? words : fmt::format("{}; not flown: {}", words, figure.missing);
}

/// @param words  number of first columns, which are aligned to the left.
std::string latex_table(const Words& head, const std::vector<Words>& rows, size_t words) {
  std::string out = fmt::format("\\begin{{tabular}}{{{}{}}}\n\\toprule\n", std::string(words, 'l'),
                                std::string(head.size() - words, 'r'));
  out += fmt::format("{} \\\\\n\\midrule\n", fmt::join(head, " & "));
  for (const Words& row : rows) out += fmt::format("{} \\\\\n", fmt::join(row, " & "));
  return out + "\\bottomrule\n\\end{tabular}\n";
}

Words column_of(const SweepAnalysis& analysis, const std::vector<size_t>& order, size_t parameter) {
  Words words;
  for (const size_t i : order) words.push_back(analysis.points.values[i][parameter]);
  return words;
}

}  // namespace

std::string ranking_csv(const FlightList& flights, const SweepAnalysis& analysis) {
  std::vector<double> rank, mean, low, high, passed, unchecked, count;
  Words numbers, commands;
  const Words all_commands = flights.table.words("command");
  for (const size_t i : analysis.ranking) {
    const PointFigure& figure = analysis.figures[i];
    rank.push_back(static_cast<double>(rank.size() + 1));
    numbers.push_back(analysis.points.numbers[i]);
    mean.push_back(figure.mean);
    low.push_back(figure.low);
    high.push_back(figure.high);
    passed.push_back(static_cast<double>(figure.passed));
    unchecked.push_back(static_cast<double>(figure.unchecked));
    count.push_back(static_cast<double>(figure.flights));
    commands.push_back(all_commands[analysis.points.rows[i][0]]);
  }
  Table table;
  table.add("rank", rank);
  table.add("point", numbers);
  for (size_t p = 0; p < analysis.points.paths.size(); ++p) {
    table.add(analysis.points.paths[p], column_of(analysis, analysis.ranking, p));
  }
  table.add("mean_" + analysis.column, mean);
  table.add("low_95", low);
  table.add("high_95", high);
  table.add("passed", passed);
  table.add("flights", count);
  table.add("no_checks", unchecked);
  table.add("command", commands);
  return table.csv();
}

std::string ranking_latex(const SweepAnalysis& analysis) {
  constexpr size_t kRows = 10;
  Words head = {"rank"};
  for (const std::string& path : analysis.points.paths) {
    const std::string& label = analysis.labels.at(path);  // the path, or "wind.speed, m/s"
    const std::string unit = label.starts_with(path) ? label.substr(path.size()) : "";
    head.push_back("\\texttt{" + latex(path) + "}" + latex(unit));
  }
  head.insert(head.end(), {"mean of " + latex(analysis.label()), "95\\,\\% interval", "passed"});
  std::vector<Words> rows;
  for (const size_t i : analysis.ranking) {
    if (rows.size() == kRows) break;
    const PointFigure& figure = analysis.figures[i];
    Words row = {std::to_string(rows.size() + 1)};
    for (const std::string& value : analysis.points.values[i]) row.push_back(latex_value(value));
    row.push_back(latex_number(figure.mean));
    row.push_back(std::isnan(figure.low) ? "--" : latex_number(figure.low) + " to " + latex_number(figure.high));
    row.push_back(passed_words(figure));
    rows.push_back(std::move(row));
  }
  return latex_table(head, rows, 0);
}

std::vector<size_t> pareto_front(const SweepAnalysis& analysis, const std::vector<PointFigure>& figures, bool less) {
  std::vector<size_t> known, passing;
  for (size_t i = 0; i < figures.size(); ++i) {
    if (std::isnan(figures[i].mean) || std::isnan(analysis.figures[i].mean)) continue;
    known.push_back(i);
    if (figures[i].none_failed()) passing.push_back(i);
  }
  if (!passing.empty() && analysis.column != "passed") known = passing;
  const auto x = [&](size_t i) { return less ? figures[i].mean : -figures[i].mean; };
  const auto y = [&](size_t i) { return analysis.less ? analysis.figures[i].mean : -analysis.figures[i].mean; };
  std::vector<size_t> front;
  for (const size_t i : known) {
    const bool beaten = std::ranges::any_of(known, [&](size_t other) {
      return x(other) <= x(i) && y(other) <= y(i) && (x(other) < x(i) || y(other) < y(i));
    });
    if (!beaten) front.push_back(i);
  }
  std::ranges::stable_sort(front, {}, x);
  return front;
}

std::string pareto_csv(const SweepAnalysis& analysis, const std::string& other,
                       const std::vector<PointFigure>& figures) {
  const std::vector<size_t> front = pareto_front(analysis, figures, !analysis.more_is_better.contains(other));
  Table table;
  Words numbers;
  std::vector<double> x, y;
  for (const size_t i : front) {
    numbers.push_back(analysis.points.numbers[i]);
    x.push_back(figures[i].mean);
    y.push_back(analysis.figures[i].mean);
  }
  table.add("point", numbers);
  for (size_t p = 0; p < analysis.points.paths.size(); ++p) {
    table.add(analysis.points.paths[p], column_of(analysis, front, p));
  }
  table.add("mean_" + other, x);
  table.add("mean_" + analysis.column, y);
  return table.csv();
}

std::string indices_csv(const SweepAnalysis& analysis, const nlohmann::ordered_json& effects) {
  constexpr const char* kNames[] = {"first", "first_low_95", "first_high_95", "total", "total_low_95", "total_high_95"};
  const size_t step = effects.at("method") == "grid" ? 3 : 1;
  Table table;
  table.add("parameter", analysis.points.paths);
  for (size_t k = 0; k < std::size(kNames); k += step) {
    std::vector<double> values;
    for (const auto& row : effects.at("columns").at(analysis.column)) values.push_back(row[k].get<double>());
    table.add(kNames[k], values);
  }
  return table.csv();
}

std::string indices_latex(const SweepAnalysis& analysis, const nlohmann::ordered_json& effects) {
  const bool exact = effects.at("method") == "grid";
  const auto& indices = effects.at("columns").at(analysis.column);
  Words heads = {"parameter", "$S_i$", "$S_{Ti}$"};
  if (!exact) heads = {"parameter", "$S_i$", "95\\,\\% interval", "$S_{Ti}$", "95\\,\\% interval"};
  std::vector<Words> rows;
  for (size_t p = 0; p < analysis.points.paths.size(); ++p) {
    const auto cell = [&](size_t k) { return with_minus(fmt::format("{:.2f}", indices[p][k].get<double>())); };
    const auto interval = [&](size_t k) { return cell(k + 1) + " to " + cell(k + 2); };
    Words& row = rows.emplace_back(Words{"\\texttt{" + latex(analysis.points.paths[p]) + "}"});
    for (const size_t k : {0U, 3U}) {
      row.push_back(cell(k));
      if (!exact) row.push_back(interval(k));
    }
  }
  return latex_table(heads, rows, 1);
}

}  // namespace hedgehop::sim
