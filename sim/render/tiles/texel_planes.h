#pragma once

#include <cstdint>

#include "scenes/texture_list.h"
#include "sim/render/tiles/huge_pages.h"
#include "sim/render/tiles/scene_view.h"

namespace hedgehop::sim::tiles {

/// The textures of a scene at every size down to one texel, in the layout of the kernels. A texel is the mean of the
/// pixels of the full image that it covers, rounded once. Greys and colors are each computed at the first use.
class TexelPlanes {
 public:
  /// @param textures  an empty list gives one black texel.
  explicit TexelPlanes(const scenes::TextureList& textures);

  const TextureLayout& layout() const { return layout_; }

  const uint16_t* greys();  ///< means of the channels
  const uint32_t* colors();

 private:
  scenes::TextureList textures_;
  TextureLayout layout_{};
  HugeVector<uint16_t> greys_;
  HugeVector<uint32_t> colors_;
};

}  // namespace hedgehop::sim::tiles
