#include "sim/flight/json_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace hedgehop::sim {

nlohmann::ordered_json json_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value;
}

nlohmann::ordered_json brief(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.5g}", value).c_str(), nullptr);
}

nlohmann::ordered_json milli(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::round(value * 1e3) / 1e3;
}

}  // namespace hedgehop::sim
