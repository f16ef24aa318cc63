#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "dynamics/vehicle.h"
#include "sim/config/input_error.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim::cli {

/// Returns `compute(vehicle)` for a vehicle's file; a vehicle that cannot fly is bad input, reported with the file's
/// name.
template <class Compute>
auto about(const std::filesystem::path& file, Compute compute) {
  const dynamics::VehicleConfig vehicle = load_vehicle(file);
  try {
    return compute(vehicle);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace hedgehop::sim::cli
