#pragma once

#include <string>
#include <vector>

#include "sim/batch/group_verdict.h"
#include "sim/evidence/conduct.h"
#include "sim/evidence/sequential_count.h"

namespace hedgehop::sim {

/// What became of a batch.
struct BatchOutcome {
  std::vector<FlightRecord> records;  ///< under a stopping rule, none past its group's stop
  std::vector<GroupVerdict> verdicts;
  std::vector<SequentialResult> sequential;  ///< one a group under a stopping rule; else empty
  Conduct conduct;

  /// Interval (95 %) of a success rate: Wilson's for a number of flights planned in advance; under a stopping rule one
  /// that holds at any time.
  Interval success_interval(Count success) const;
  std::string interval_method() const;  ///< "wilson" or "anytime"
};

/// Returns the verdict on a batch: on its claims under a stopping rule, else on its checks over the seeds, else on its
/// flights.
Standing verdict_of(const BatchOutcome& outcome);

/// Text of batch.json: version, build, how it was to be flown, groups with the success rate's interval (95 %), verdicts
/// over the seeds, what a stopping rule found, and every flight with its order, status, cause, re-run command and
/// result.
std::string batch_json(const BatchOutcome& outcome, const std::string& version);

/// The groups as a table in Markdown, below a line that names the builds where there are several, for people and for
/// documents; then the flights that did not pass, each with its cause and the command that re-simulates it; then what
/// holds over the seeds.
std::string summary_text(const BatchOutcome& outcome);

/// What failed in a flight, one line: its cause, or the checks that do not hold with value and limit; "" when it
/// passed.
std::string failure_words(const FlightRecord& record);

}  // namespace hedgehop::sim
