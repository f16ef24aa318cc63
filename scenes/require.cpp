#include "scenes/require.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace hedgehop::scenes {

void require(bool holds, std::string_view field, double value, std::string_view valid) {
  if (holds) return;
  std::ostringstream line;
  line << field << ": " << value << "; valid: " << valid;
  throw std::invalid_argument(line.str());
}

void require_clearings(const std::vector<Clearing>& clearings) {
  for (const Clearing& clearing : clearings) {
    require(std::isfinite(clearing.north_m), "keep_clear.north", clearing.north_m, "a finite number");
    require(std::isfinite(clearing.east_m), "keep_clear.east", clearing.east_m, "a finite number");
    require(clearing.radius_m >= 0.0, "keep_clear.radius", clearing.radius_m, "at least 0 m");
  }
}

void require_texture_size(double size_px) {
  int exponent = 0;
  const bool power_of_two = std::frexp(size_px, &exponent) == 0.5;
  require(power_of_two && size_px >= 64.0 && size_px <= 2048.0, "texture_size", size_px,
          "a power of two from 64 to 2048");
}

}  // namespace hedgehop::scenes
