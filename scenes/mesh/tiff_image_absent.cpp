#include "scenes/mesh/texture_image.h"

namespace hedgehop::scenes::mesh {

cv::Mat decode_tiff(std::span<const uint8_t>) { return {}; }

}  // namespace hedgehop::scenes::mesh
