#pragma once

#include <string>
#include <vector>

#include "sim/campaign/verdict.h"

namespace hedgehop::sim {

/// Text of batch.json: version, build, totals, groups with Wilson interval (95 %), verdicts over the seeds, and every
/// flight with its order, status, cause, re-run command and result.
std::string batch_json(const std::vector<FlightRecord>& records, const std::vector<GroupVerdict>& verdicts,
                       const std::string& version);

/// The groups as a table in Markdown, below a line that names the builds where there are several, for people and for
/// documents; then the flights that did not pass, each with its cause and the command that re-simulates it.
std::string summary_text(const std::vector<FlightRecord>& records, const std::vector<GroupVerdict>& verdicts);

/// What failed in a flight, one line: its cause, or the checks that do not hold with value and limit; "" when it
/// passed.
std::string failure_words(const FlightRecord& record);

}  // namespace hedgehop::sim
