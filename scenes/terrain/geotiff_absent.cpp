#include <stdexcept>

#include "scenes/terrain/heightmap.h"

namespace hedgehop::scenes::terrain {

Heightmap heights_of_tiff(std::span<const uint8_t>) {
  throw std::invalid_argument(
      "it is no PNG, and this build of Hedgehop cannot read TIFF (see hedgehop --version --features)");
}

}  // namespace hedgehop::scenes::terrain
