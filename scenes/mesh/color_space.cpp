#include <cmath>

#include "scenes/mesh/model.h"

namespace hedgehop::scenes::mesh {

// Source: the transfer function of sRGB, IEC 61966-2-1.
float srgb_of_linear(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float linear_of_srgb(float srgb) { return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f); }

}  // namespace hedgehop::scenes::mesh
