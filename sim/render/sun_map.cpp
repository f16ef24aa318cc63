#include "sim/render/sun_map.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <stdexcept>
#include <vector>

#include "sim/render/shaders.h"
#include "sim/render/visible_chunks.h"

namespace hedgehop::sim {

namespace {

constexpr int kFewTexels = 2048, kManyTexels = 4096;
constexpr double kFineEnoughM = 0.05;

std::vector<scenes::Chunk> casters(const SceneBuffers& buffers) {
  std::vector<scenes::Chunk> chunks;
  for (const scenes::Chunk& chunk : buffers.chunks) {
    if (!lies_flat(chunk) && chunk.index_count > 0) chunks.push_back(chunk);
  }
  return chunks;
}

/// From W to L, the axes of a camera that looks along the light, so that triangles have the same winding as in images.
Eigen::Matrix3d sun_axes(const Eigen::Vector3f& to_sun_W) {
  const Eigen::Vector3d forward = -to_sun_W.cast<double>().normalized(), right = forward.unitOrthogonal();
  Eigen::Matrix3d R_LW;
  R_LW << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  return R_LW;
}

Eigen::AlignedBox3d bounds(const std::vector<scenes::Chunk>& chunks, const Eigen::Matrix3d& R_LW) {
  Eigen::AlignedBox3d box(Eigen::Vector3d::Constant(-1.0), Eigen::Vector3d::Constant(1.0));
  if (!chunks.empty()) box.setEmpty();
  for (const scenes::Chunk& chunk : chunks) {
    for (int corner = 0; corner < 8; ++corner) {
      const auto type = static_cast<Eigen::AlignedBox3f::CornerType>(corner);
      box.extend(R_LW * chunk.box_W.corner(type).cast<double>());
    }
  }
  return box;
}

/// Binds a framebuffer that holds nothing but the map.
GLuint make_map(const GlFunctions& gl, int texels) {
  GLuint texture = 0, framebuffer = 0;
  gl.GenTextures(1, &texture);
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, texels, texels, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  // Four comparisons are mixed; beside the map, whose border is farthest, all is lit.
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
  gl.ActiveTexture(GL_TEXTURE0);

  gl.GenFramebuffers(1, &framebuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture, 0);
  gl.DrawBuffer(GL_NONE);
  gl.ReadBuffer(GL_NONE);
  const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error(
        fmt::format("no map of {} x {} texels for shadows (OpenGL status {:#06x})", texels, texels, status));
  }
  gl.Viewport(0, 0, texels, texels);
  return texture;
}

}  // namespace

SunMap draw_sun_map(const GlFunctions& gl, const SceneBuffers& buffers, const Eigen::Vector3f& to_sun_W) {
  const std::vector<scenes::Chunk> chunks = casters(buffers);
  const Eigen::Matrix3d R_LW = sun_axes(to_sun_W);
  const Eigen::AlignedBox3d box = bounds(chunks, R_LW);
  const double across_m = box.sizes().head<2>().maxCoeff();
  const int texels = across_m > kFewTexels * kFineEnoughM ? kManyTexels : kFewTexels;
  constexpr int kMarginTexels = 4;

  SunMap map;
  map.texel_m = across_m / (texels - 2 * kMarginTexels);
  const double side_m = map.texel_m * texels, deep_m = box.sizes().z() + 2.0 * map.texel_m;
  const Eigen::Vector3d scale(1.0 / side_m, 1.0 / side_m, -1.0 / deep_m);
  Eigen::Affine3d from_W = Eigen::Translation3d(0.5, 0.5, 0.5) * Eigen::Scaling(scale) *
                           Eigen::Translation3d(-box.center()) * Eigen::Affine3d(R_LW);
  map.from_W = from_W.matrix().cast<float>();
  map.texture = make_map(gl, texels);

  const Program program = sun_map_program(gl);
  gl.UseProgram(program.id);
  gl.UniformMatrix4fv(program.sun_from_W, 1, GL_FALSE, map.from_W.data());
  // A sampler compares with the four texels next to a place, each less than one away along both axes: a slanted
  // surface must lie deeper in the map by twice what it rises on a texel, or it would darken itself.
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(-2.0f, 0.0f);
  const float farthest = 0.0f;
  gl.ClearBufferfv(GL_DEPTH, 0, &farthest);
  for (const scenes::Chunk& chunk : chunks) {
    gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(chunk.index_count), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(chunk.first_index * sizeof(uint32_t)));
  }
  gl.Disable(GL_POLYGON_OFFSET_FILL);
  check_gl(gl, "drawing where the sun shines");
  return map;
}

}  // namespace hedgehop::sim
