#include "sim/render/painter.h"

#include "sim/render/gl_painter.h"
#include "sim/render/tiles/tile_painter.h"

namespace hedgehop::sim {

bool Painter::paint_flow(const vision::camera::PinholeCamera&, const Eye&, const Next&, cv::Mat&) { return false; }

std::unique_ptr<Painter> make_painter(const scenes::Scene& scene, Culling culling, RendererKind kind, Shadows shadows) {
  if (kind == RendererKind::tiles) return std::make_unique<tiles::TilePainter>(scene, culling, shadows);
  return std::make_unique<GlPainter>(scene, culling, kind, shadows);
}

}  // namespace hedgehop::sim
