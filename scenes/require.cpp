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

void require_texture_size(double size_px) {
  int exponent = 0;
  const bool power_of_two = std::frexp(size_px, &exponent) == 0.5;
  require(power_of_two && size_px >= 64.0 && size_px <= 2048.0, "texture_size", size_px,
          "a power of two from 64 to 2048");
}

}  // namespace hedgehop::scenes
