#pragma once

#include <vector>

#include "sim/render/tiles/frame.h"

namespace hedgehop::sim::tiles {

/// The memory of frames, kept from image to image.
class FrameMemory {
 public:
  /// Allocates memory for typical views. A view with more surfaces than all before allocates more.
  /// @param facets  number of facets in the scene.
  explicit FrameMemory(size_t facets);
  FrameMemory(const FrameMemory&) = delete;
  FrameMemory& operator=(const FrameMemory&) = delete;

  /// Starts an image without facets and poses. @param samples  1 or 4.
  Frame& begin(const PinholeImage& lens, int samples);

  Frame& frame() { return frame_; }
  const Frame& frame() const { return frame_; }

  /// Adds the pose of the camera in W, or in the frame of a moving obstacle.
  void add_pose(const ViewPose& pose);

  /// Provides space for this number of further surfaces.
  void reserve_surfaces(size_t count);

  /// Provides space for the interpolants of all surfaces.
  void reserve_interpolants();

 private:
  friend void grow(Frame&, Tile&);

  uint32_t take_layers(size_t count);

  Frame frame_{};
  std::vector<Tile> tiles_;
  std::vector<ViewPose> poses_;
  std::vector<Surface> surfaces_;
  std::vector<Interpolants> interpolants_;
  std::vector<Layer> pool_;
  size_t pool_used_ = 0;
};

}  // namespace hedgehop::sim::tiles
