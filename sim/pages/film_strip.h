#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/batch/record.h"

namespace hedgehop::sim {

/// Rows of the most interesting flights, at most `count` of them: half collisions, earliest first, half those of the
/// least clearance to obstacles without one; more of one kind where the other is rarer.
std::vector<size_t> worst_flights(const std::vector<FlightRecord>& records, size_t count);

/// Flies flights of a campaign's folder again, each up to its collision or closest approach, and leaves a `strip.jpg`
/// in the folder of each: five images that its module saw, the last at most a film's period before that moment.
/// Batches make no films; equal scenarios give equal flights, so nothing is shown that was not flown.
/// @param rows  of `records`. @param on_begin  called with each flight before it is flown.
/// @return one line for each flight without a strip: its folder is gone, no image was drawn, or its closest approach
/// came out differently (by another build or on another kind of processor).
std::vector<std::string> write_film_strips(const std::filesystem::path& folder,
                                           const std::vector<FlightRecord>& records, const std::vector<size_t>& rows,
                                           const std::function<void(const std::string& id)>& on_begin);

}  // namespace hedgehop::sim
