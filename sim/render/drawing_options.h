#pragma once

namespace hedgehop::sim {

/// Whether the image shows shadows of the sun.
enum class Shadows { none, sun };

/// The parts of a scene that are left out before rendering because the camera cannot see them. The choice affects the
/// cost only; images are equal, except for pixels at a crack of a mesh, which may show a different background.
enum class Culling { none, frustum, frustum_and_horizon };

}  // namespace hedgehop::sim
