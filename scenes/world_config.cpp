#include "scenes/world_config.h"

#include <bit>
#include <sstream>
#include <stdexcept>

#include "sim/fields/invalid_field.h"

namespace hedgehop::scenes {

void require(bool holds, std::string_view field, double value, std::string_view valid) {
  if (holds) return;
  std::ostringstream line;
  line << value << "; valid: " << valid;
  throw fields::InvalidField(std::string(field), line.str());
}

void require_texture_size(int64_t size_px) {
  require(std::has_single_bit(static_cast<uint64_t>(size_px)), "texture_size", static_cast<double>(size_px),
          "a power of two");
}

}  // namespace hedgehop::scenes
