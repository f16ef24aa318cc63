#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/batch/record.h"

namespace hedgehop::sim {

/// Returns the rows of the worst flights, at most `count`, failed flights first. Half of the failed ones are
/// collisions, earliest first; half are others, such as timeouts, in the order of their minimum clearance. If one kind
/// has too few flights, the other kind fills the rest. Flights that did not fail follow in the order of their minimum
/// clearance.
std::vector<size_t> worst_flights(const std::vector<FlightRecord>& records, size_t count);

/// Re-simulates flights of a campaign up to their collision, their failed end or their closest approach, and writes a
/// `strip.jpg` into the folder of each flight: five images of its cameras, the last one at most one film period before
/// that moment. Equal scenarios give equal flights, so the strips show the recorded flights.
/// @param rows  of `records`. @param on_begin  called before each flight.
/// @return one line for each flight without a strip: its folder is missing, no image was rendered, or the closest
/// approach differs (another build, or another type of processor).
std::vector<std::string> write_film_strips(const std::filesystem::path& folder,
                                           const std::vector<FlightRecord>& records, const std::vector<size_t>& rows,
                                           const std::function<void(const std::string& id)>& on_begin);

}  // namespace hedgehop::sim
