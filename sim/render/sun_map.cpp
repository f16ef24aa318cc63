#include "sim/render/sun_map.h"

#include <fmt/format.h>

#include <stdexcept>

#include "sim/render/shaders.h"
#include "sim/render/sun_plan.h"

namespace hedgehop::sim {

namespace {

/// Binds a framebuffer that holds nothing but the map.
void make_map(const GlFunctions& gl, int texels) {
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
}

}  // namespace

Eigen::Matrix4f draw_sun_map(const GlFunctions& gl, const std::vector<scenes::Chunk>& chunks,
                             const Eigen::Vector3f& to_sun_W) {
  const SunPlan plan = plan_sun_map(chunks, to_sun_W);
  const Eigen::Matrix4f from_W = plan.from_W.matrix().cast<float>();
  make_map(gl, plan.texels);

  const Program program = sun_map_program(gl);
  gl.UseProgram(program.id);
  gl.UniformMatrix4fv(program.sun_from_W, 1, GL_FALSE, from_W.data());
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(-static_cast<float>(kSunSlack), 0.0f);
  const float farthest = 0.0f;
  gl.ClearBufferfv(GL_DEPTH, 0, &farthest);
  for (const scenes::Chunk& chunk : plan.casters) {
    gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(chunk.index_count), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(chunk.first_index * sizeof(uint32_t)));
  }
  gl.Disable(GL_POLYGON_OFFSET_FILL);
  check_gl(gl, "drawing where the sun shines");
  return from_W;
}

}  // namespace hedgehop::sim
