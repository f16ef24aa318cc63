#include <webp/decode.h>

#include "scenes/mesh/texture_image.h"

namespace hedgehop::scenes::mesh {

cv::Mat decode_webp(std::span<const uint8_t> bytes) {
  WebPBitstreamFeatures features{};
  if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK || features.has_animation != 0) return {};
  require_size(features.width, features.height);
  const bool has_alpha = features.has_alpha != 0;
  cv::Mat image(features.height, features.width, has_alpha ? CV_8UC4 : CV_8UC3);
  const auto decode = has_alpha ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
  const size_t size = image.total() * image.elemSize();
  return decode(bytes.data(), bytes.size(), image.data, size, static_cast<int>(image.step)) ? image : cv::Mat();
}

}  // namespace hedgehop::scenes::mesh
