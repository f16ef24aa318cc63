#pragma once

#include <vector>

#include "sim/render/painter.h"
#include "sim/render/scene_geometry.h"
#include "sim/render/tiles/facets.h"
#include "sim/render/tiles/frame_memory.h"
#include "sim/render/tiles/kernels.h"
#include "sim/render/tiles/texel_planes.h"

namespace hedgehop::sim::tiles {

/// Draws on the processor alone. Facets go into tiles of 8 x 8 pixels from near to far; what hides what is settled by
/// their planes, without a depth for each pixel; each pixel is shaded once, at the end. The same bits on every
/// processor.
class TilePainter : public Painter, private VisibleChunks::Beholder {
 public:
  /// Throws std::invalid_argument for a scene that contradicts itself, std::runtime_error as chosen_kernels() does.
  TilePainter(const scenes::Scene& scene, Culling culling, Shadows shadows);

  void paint(const vision::camera::PinholeCamera& camera, const Eye& eye, Raster raster, int samples,
             cv::Mat& out) override;
  bool paint_flow(const vision::camera::PinholeCamera& camera, const Eye& eye, const Next& next, cv::Mat& out) override;
  void require_samples(int samples) override;
  std::string info() override;

 private:
  void see(const scenes::Chunk& stretch) override;
  bool hides(const Eigen::AlignedBox3f& box_W) const override;
  void draw_scene(const vision::camera::PinholeCamera& camera, const Painter::Eye& eye, int samples);
  void draw_movers(const Painter::Eye& eye);
  void draw(const scenes::Chunk& stretch, uint32_t eye);
  void color_scene(bool color);

  const Kernels& kernels_;
  Culling culling_;
  SceneGeometry geometry_;               ///< its chunks
  std::vector<scenes::Motion> motions_;  ///< of the movers
  VisibleChunks visible_;
  Facets facets_;
  TexelPlanes texels_;
  scenes::Sky sky_;
  HugeVector<float> sun_depths_;
  std::vector<SunBlock> sun_blocks_[SunBlocks::kLevels];
  SceneView view_{};
  FrameMemory memory_;
  std::vector<double> p_CnC_m_;  ///< of NextView
};

}  // namespace hedgehop::sim::tiles
