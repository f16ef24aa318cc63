#pragma once

#include <vector>

#include "sim/render/tiles/frame.h"

namespace hedgehop::sim::tiles {

/// Memory of frames, kept from image to image.
class FrameMemory {
 public:
  /// Has room for what ordinary views show; a fuller one than any before takes more.
  /// @param facets  of the scene.
  explicit FrameMemory(size_t facets);
  FrameMemory(const FrameMemory&) = delete;
  FrameMemory& operator=(const FrameMemory&) = delete;

  /// Begins an image without facets and eyes. @param samples  1 or 4.
  Frame& begin(const Lens& lens, int samples);

  Frame& frame() { return frame_; }
  const Frame& frame() const { return frame_; }

  /// Adds an eye to draw from.
  void add_eye(const Eye& eye);

  /// Makes room for the surfaces of so many facets.
  void make_room(size_t facets);

  /// Makes room for the paints of all surfaces that were drawn.
  void make_paints();

 private:
  friend void grow(Frame&, Tile&);

  uint32_t take_layers(size_t count);

  Frame frame_{};
  std::vector<Tile> tiles_;
  std::vector<Eye> eyes_;
  std::vector<Surface> surfaces_;
  std::vector<Paint> paints_;
  std::vector<Layer> pool_;
  size_t pool_used_ = 0;
};

}  // namespace hedgehop::sim::tiles
