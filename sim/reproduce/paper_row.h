#pragma once

#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/reproduce/measured_figure.h"

namespace hedgehop::sim {

/// A row of a paper with the figures measured by Hedgehop.
struct RowOutcome {
  PaperRow row;
  MeasuredFigure modified;  ///< with the sensors of the scenario, `day`; for a calculation, only its value
  /// The variants "published", "ideal", "dull"; a variant is absent if an entry of the row's flights lacks it.
  std::map<std::string, MeasuredFigure> variants;
  /// Empty without a requirement, and for a row that is not part of a quick run. False if a required flight was not
  /// flown, had a fault, lacks the figure (unless the row defines its meaning) or, for a row that allows no contact,
  /// did not finish; and if there is no measured figure. Variants do not affect it.
  std::optional<bool> holds;
  std::optional<bool> published_holds;  ///< whether the published law meets the requirement; not part of `holds`
  std::string command;                  ///< re-simulates `modified`
  std::set<std::string> builds;         ///< of `modified` and the variants

  /// Returns whether there is a figure, or the row is not part of a quick run.
  bool measured() const;
  std::string required_words() const;                           ///< "at most 0"
  std::string modified_words() const;                           ///< "0 of 30"
  std::string variant_words(const std::string& variant) const;  ///< "-" without the variant
  std::string flights_words() const;  ///< "30, 30, 0, 30": required, flown, faulted, with the figure; then exceptions
  std::string interval_words() const;
  std::string holds_words() const;  ///< "yes", "no" or "-"
};
std::vector<RowOutcome> row_outcomes(const PaperOutcome& outcome);

/// Returns whether every row is measured and meets its requirement.
bool all_hold(const std::vector<RowOutcome>& rows);

/// Rows of all papers.
using RowsOfPapers = std::vector<std::pair<Paper, std::vector<RowOutcome>>>;

/// Returns a paper's rows in Markdown: a heading, a table, and the deviations from the paper.
std::string rows_text(const Paper& paper, const std::vector<RowOutcome>& rows);

/// Returns the rows of all papers as comma-separated values with a header line.
std::string rows_csv(const RowsOfPapers& papers);

}  // namespace hedgehop::sim
