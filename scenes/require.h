#pragma once

#include <string_view>
#include <vector>

#include "scenes/clearing.h"

namespace hedgehop::scenes {

/// Throws std::invalid_argument "<field>: <value>; valid: <valid>" unless `holds`.
void require(bool holds, std::string_view field, double value, std::string_view valid);

/// Requires finite centers and radii of at least 0.
void require_clearings(const std::vector<Clearing>& clearings);

/// Requires a power of two within 64..2048.
void require_texture_size(double size_px);

}  // namespace hedgehop::scenes
