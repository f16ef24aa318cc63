#pragma once

namespace hedgehop::avoidance {

/// What a camera's frames hold; `corners`: those of a corner detector in its place, instead of images.
enum class CameraChannel { grey, color, depth, corners };

}  // namespace hedgehop::avoidance
