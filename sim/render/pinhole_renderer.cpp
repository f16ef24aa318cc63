#include "sim/render/pinhole_renderer.h"

#include <opencv2/core.hpp>
#include <stdexcept>

#include "sim/render/gl_renderer.h"
#include "sim/render/tiles/tile_renderer.h"

namespace hedgehop::sim {

int type_of(Raster raster) {
  switch (raster) {
    case Raster::grey:
      return CV_8UC1;
    case Raster::color:
      return CV_8UC3;
    case Raster::depth:
      return CV_32FC1;
    case Raster::planes:
      return CV_32FC4;
    case Raster::labels:
      return CV_32SC1;
  }
  throw std::invalid_argument("unknown raster");
}

bool PinholeRenderer::render_flow(const vision::camera::PinholeCamera&, const Viewpoint&, const FlowTarget&, cv::Mat&) {
  return false;
}

std::unique_ptr<PinholeRenderer> make_pinhole_renderer(const scenes::Scene& scene, Culling culling, RendererKind kind,
                                                       Shadows shadows) {
  if (kind == RendererKind::tiles) return std::make_unique<tiles::TileRenderer>(scene, culling, shadows);
  return std::make_unique<GlRenderer>(scene, culling, kind, shadows);
}

}  // namespace hedgehop::sim
