#pragma once

namespace hedgehop::avoidance {

/// Content of the frames of a camera. `corners`: the positions that a corner detector found, instead of images.
enum class CameraChannel { grey, color, depth, corners };

}  // namespace hedgehop::avoidance
