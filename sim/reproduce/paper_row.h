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
  MeasuredFigure modified;  ///< on the sensors of the scenario, `day`; of a calculation its value alone
  /// The variants "published", "ideal", "dull": none where an entry of the row's flights lacks it.
  std::map<std::string, MeasuredFigure> variants;
  /// None without a requirement, and of a row that a quick look leaves out. False where a flight that was asked for was
  /// not flown, faulted, lacks the figure (unless the row says what that means) or, of a row that allows no contact,
  /// did not finish; and where nothing was measured. Variants do not decide it.
  std::optional<bool> holds;
  std::optional<bool> published_holds;  ///< whether the published law meets the requirement; not part of `holds`
  std::string command;                  ///< re-simulates `modified`
  std::set<std::string> builds;         ///< of `modified` and the variants

  /// Whether there is a figure, or none was asked for in a quick look.
  bool measured() const;
  std::string required_words() const;                           ///< "at most 0"
  std::string modified_words() const;                           ///< "0 of 30"
  std::string variant_words(const std::string& variant) const;  ///< "-" without the variant
  std::string flights_words() const;  ///< "30, 30, 0, 30": asked, flown, faulted, with the figure; then what is odd
  std::string interval_words() const;
  std::string holds_words() const;  ///< "yes", "no" or "-"
};
std::vector<RowOutcome> row_outcomes(const PaperOutcome& outcome);

/// Whether every row is measured and none fails what it requires.
bool all_hold(const std::vector<RowOutcome>& rows);

/// Rows of all papers by the paper's key.
using RowsOfPapers = std::vector<std::pair<Paper, std::vector<RowOutcome>>>;

/// A paper's rows for people and documents: a heading and a table in Markdown, then what departs from the paper.
std::string rows_text(const Paper& paper, const std::vector<RowOutcome>& rows);

/// Rows of all papers as comma-separated values with a header line.
std::string rows_csv(const RowsOfPapers& papers);

}  // namespace hedgehop::sim
