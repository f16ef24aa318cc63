#pragma once

#include <string>
#include <vector>

#include "sim/batch/group_verdict.h"
#include "sim/evidence/conduct.h"
#include "sim/evidence/sequential_count.h"

namespace hedgehop::sim {

/// Returns the interval (95 %) of a success rate: Wilson's for a number of flights planned in advance. @param anytime
/// whether flights were stopped depending on their results: the interval then holds at any time.
Interval success_interval(Count success, bool anytime);

/// The results of a batch.
struct BatchOutcome {
  std::vector<FlightRecord> records;  ///< under a stopping rule, none past its group's stop
  std::vector<GroupVerdict> verdicts;
  std::vector<SequentialResult> sequential;  ///< one per group under a stopping rule, else empty
  Conduct conduct;

  std::string interval_method() const;  ///< of success_interval(): "wilson" or "anytime"
};

/// Returns the verdict on a batch: on its claims under a stopping rule, else on its checks over the seeds, else on its
/// flights.
Standing verdict_of(const BatchOutcome& outcome);

/// Returns the text of batch.json: version, build, conduct, groups with the interval (95 %) of their success rate,
/// verdicts over the seeds, results of the stopping rule, and every flight with its order, status, cause, re-run
/// command and result.
std::string batch_json(const BatchOutcome& outcome, const std::string& version);

/// Returns the groups as a Markdown table, below a line that names the builds if there are several; then the flights
/// that did not pass, each with its cause and re-run command; then the verdicts over the seeds.
std::string summary_text(const BatchOutcome& outcome);

/// Returns one line with the cause of a failed flight, or its failed checks with value and limit; "" if it passed.
std::string failure_words(const FlightRecord& record);

}  // namespace hedgehop::sim
