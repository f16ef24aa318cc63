#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace hedgehop::sim {

/// Returns a number for JSON, which has no words for what is not finite: null in its place.
inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace hedgehop::sim
