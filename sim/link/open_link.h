#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "sim/loop/outside_autopilot.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim::link {

/// Name of the recording in the folder of a run.
inline constexpr const char* kRecordingName = "link.bin";

/// Address and files of a link.
struct LinkOptions {
  std::string bind = "127.0.0.1";  ///< numeric address on which the physics is served
  int64_t worker = 0;              ///< number of a parallel flight, added to the link's instance
  std::filesystem::path out;       ///< folder of the run, for the recording and the autopilot's own files
  std::filesystem::path replay;    ///< recording that replaces the autopilot; empty for a live link
};

/// Returns the autopilot of a scenario's link: opens the port and starts its program, if the link names one, or opens
/// the recording. The module of the scenario exchanges messages with it. Throws InputError with one line for a port in
/// use, a program that cannot be started and a recording that cannot be read.
std::unique_ptr<OutsideAutopilot> open_link(const Scenario& scenario, const LinkOptions& options);

/// Returns the autopilot of a run's recording; null for a scenario without a link. @param run_folder  of the run.
std::unique_ptr<OutsideAutopilot> recorded_link(const Scenario& scenario, const std::filesystem::path& run_folder);

}  // namespace hedgehop::sim::link
