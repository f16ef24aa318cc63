#pragma once

#include <nlohmann/json_fwd.hpp>

/// Numbers for JSON, which has no notation for values that are not finite: null replaces them.
namespace hedgehop::sim {

nlohmann::ordered_json json_number(double value);

/// Rounded to five significant figures.
nlohmann::ordered_json brief(double value);

/// Rounded to three decimals.
nlohmann::ordered_json milli(double value);

}  // namespace hedgehop::sim
