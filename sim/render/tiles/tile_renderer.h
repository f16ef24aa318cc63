#pragma once

#include <vector>

#include "sim/render/far_details.h"
#include "sim/render/pinhole_renderer.h"
#include "sim/render/scene_geometry.h"
#include "sim/render/tiles/box_queue.h"
#include "sim/render/tiles/box_tree.h"
#include "sim/render/tiles/facets.h"
#include "sim/render/tiles/frame_memory.h"
#include "sim/render/tiles/kernels.h"
#include "sim/render/tiles/texel_planes.h"

namespace hedgehop::sim::tiles {

/// Hedgehop's own rasterizer. Inserts facets into tiles of 8 x 8 pixels from near to far. Visibility follows from the
/// planes of the facets, without a depth per pixel. Each pixel is shaded once, at the end. The bits are equal on every
/// processor.
class TileRenderer : public PinholeRenderer {
 public:
  /// Throws std::invalid_argument for an inconsistent scene, std::runtime_error as chosen_kernels().
  TileRenderer(const scenes::Scene& scene, Culling culling, Shadows shadows);

  void render(const vision::camera::PinholeCamera& camera, const Viewpoint& view, Raster raster, int samples,
              cv::Mat& out) override;
  bool render_flow(const vision::camera::PinholeCamera& camera, const Viewpoint& view, const FlowTarget& next,
                   cv::Mat& out) override;
  void require_samples(int samples) override;
  std::string info() override;

 private:
  void draw_scene(const vision::camera::PinholeCamera& camera, const Viewpoint& view, int samples);
  /// A chunk or a part of a flat one, and its facets.
  struct alignas(64) Stretch {
    Eigen::AlignedBox3f box_W;
    scenes::FarDetail far;
    uint32_t index_count;
    Facets::FacetRange facets, far_facets;
  };
  struct Stretches {
    BoxTree tree;
    std::vector<Stretch> of_leaf;
  };

  Stretches stretches_of(const std::vector<scenes::Chunk>& chunks) const;
  void draw(const Stretches& stretches, const BoxCamera& boxes, const FarDetails& far_details);
  void draw_movers(const Viewpoint& view);
  void draw(Facets::FacetRange facets, uint32_t index_count, uint32_t pose);
  void color_scene(bool color);

  const Kernels& kernels_;
  Culling culling_;
  SceneGeometry geometry_;               ///< chunks of movers only
  std::vector<scenes::Motion> motions_;  ///< of the moving obstacles
  Stretches upright_, flat_;
  BoxQueue queue_;
  Facets facets_;
  TexelPlanes texels_;
  scenes::Sky sky_;
  HugeVector<float> sun_depths_;
  std::vector<SunBlock> sun_blocks_[SunBlocks::kLevels];
  SceneView view_{};
  FrameMemory memory_;
  std::vector<NextPose> next_poses_;  ///< of the last flow image
};

}  // namespace hedgehop::sim::tiles
