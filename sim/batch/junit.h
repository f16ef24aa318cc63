#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/batch/group_verdict.h"
#include "sim/batch/record.h"

namespace hedgehop::sim {

/// Time and machine of a JUnit file.
struct JUnitOrigin {
  std::string timestamp;  ///< UTC, such as "2026-11-28T04:21:01"
  std::string hostname;
};
/// Returns the present time and this machine.
JUnitOrigin junit_origin();

/// Files of flights by the ids of their orders, as paths relative to the folder of the JUnit file.
using Attachments = std::map<std::string, std::vector<std::string>>;

/// A JUnit file: a flight is a test suite, "flight" (whether it ended at all) and each check a test case, with value,
/// limit and the command that re-simulates it; each statistical verdict is a case of the suite "over the seeds".
/// Names of cases are unique within their suite. It holds the XSD of Jenkins' xunit plugin.
/// @param verdicts  if not empty, they decide, and the failed check of a single flight is reported as skipped.
std::string junit_text(const std::vector<FlightRecord>& records, const std::vector<GroupVerdict>& verdicts,
                       const JUnitOrigin& origin, const Attachments& attachments = {});

/// Returns the JUnit file of a command that was refused: one error per fault, in a suite of their own. Without faults
/// its only case passes.
std::string junit_of_bad_input(const std::vector<std::string>& faults, const JUnitOrigin& origin);

}  // namespace hedgehop::sim
