#pragma once

#include <cstdint>
#include <string_view>

namespace hedgehop::scenes {

/// For what relates fields to each other; fields::require_bounds() judges each alone.
/// Throws std::invalid_argument "<field>: <value>; valid: <valid>" unless `holds`.
void require(bool holds, std::string_view field, double value, std::string_view valid);

/// Requires a power of two.
void require_texture_size(int64_t size_px);

}  // namespace hedgehop::scenes
