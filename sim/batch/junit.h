#pragma once

#include <string>
#include <vector>

#include "sim/batch/group_verdict.h"
#include "sim/batch/record.h"

namespace hedgehop::sim {

/// A JUnit file: a flight is a test suite, "flight" (whether it ended at all) and each check a test case, with value,
/// limit and the command that re-simulates it; each statistical verdict is a case of the suite "over the seeds".
/// @param verdicts  if not empty, they decide, and the failed check of a single flight is reported as skipped.
std::string junit_text(const std::vector<FlightRecord>& records, const std::vector<GroupVerdict>& verdicts);

}  // namespace hedgehop::sim
