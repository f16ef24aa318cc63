#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "avoidance/module.h"
#include "sim/config/input_error.h"
#include "sim/scenario/flight_parts.h"

/// The one validation of a scenario: of files, of texts, and of structs that a program fills in.
namespace hedgehop::sim {

struct Validation {
  std::vector<FieldError> errors;
  std::optional<FlightParts> parts;  ///< none if a part cannot be built
};

/// Source of the module that flies. A module from the caller is not validated, and the parts then contain no module.
enum class ModuleOwner { scenario, caller };

/// Checks the bounds of every field, mounts the rig (mount_rig()), then checks that the fields fit each other and that
/// each part can be built. Returns all errors and the parts.
Validation validate(Scenario& scenario, ModuleOwner source = ModuleOwner::scenario);

/// Returns why the signals of a module cannot be columns of decisions.csv: a name that is no name, occurs twice, or is
/// one of the record's own columns; "" if they can.
std::string signal_fault(std::span<const avoidance::Signal> signals);

/// Returns the errors of the checks: min above max, unknown names, missing files, times after the flight. The paths
/// begin with "checks".
std::vector<FieldError> check_errors(const Scenario& scenario);

/// Returns the errors of the link to an autopilot: motors that are not those of its frame, missing servos, a physics
/// rate below its loop rate.
std::vector<FieldError> link_errors(const Scenario& scenario);

/// Returns the names of a scenario's checks as in its results, including the implied one.
std::vector<std::string> check_names(const Scenario& scenario);

}  // namespace hedgehop::sim
