#include "sim/render/gl_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "sim/render/shaders.h"
#include "sim/render/sun_plan.h"

namespace hedgehop::sim {

namespace {

/// Returns the image at every size down to 1 x 1, CV_8UC4: R, G, B and 255. Each pixel is the mean of the pixels of the
/// full image that it covers, rounded once.
/// @param image  CV_8UC3 RGB, square; the width is a power of two.
std::vector<cv::Mat> texture_pyramid(const cv::Mat& image) {
  std::vector<cv::Mat> levels;
  cv::Mat exact, smaller, rounded;
  image.convertTo(exact, CV_32F);
  for (;;) {
    exact.convertTo(rounded, CV_8U);
    cv::cvtColor(rounded, levels.emplace_back(), cv::COLOR_RGB2RGBA);
    if (exact.cols == 1) return levels;
    cv::resize(exact, smaller, {}, 0.5, 0.5, cv::INTER_AREA);
    cv::swap(exact, smaller);
  }
}

}  // namespace

void upload_meshes(const GlFunctions& gl, const SceneGeometry& geometry) {
  const std::vector<DrawnVertex>& vertices = geometry.vertices;
  const std::vector<uint32_t>& indices = geometry.indices;
  GLuint vertex_array = 0;
  std::array<GLuint, 2> names{};
  gl.GenVertexArrays(1, &vertex_array);
  gl.BindVertexArray(vertex_array);
  gl.GenBuffers(2, names.data());
  gl.BindBuffer(GL_ARRAY_BUFFER, names[0]);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(DrawnVertex)), vertices.data(),
                GL_STATIC_DRAW);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, names[1]);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(uint32_t)), indices.data(),
                GL_STATIC_DRAW);
  const auto attribute = [&](GLuint index, GLint floats, size_t offset) {
    gl.EnableVertexAttribArray(index);
    gl.VertexAttribPointer(index, floats, GL_FLOAT, GL_FALSE, sizeof(DrawnVertex),
                           reinterpret_cast<const void*>(offset));
  };
  attribute(kPositionAttribute, 3, offsetof(DrawnVertex, p_W));
  attribute(kSurfaceAttribute, 4, offsetof(DrawnVertex, uv));
  attribute(kLabelAttribute, 1, offsetof(DrawnVertex, label));
  check_gl(gl, "copying the meshes to the context");
}

// Grey and color images share one array. llvmpipe filters four 8-bit channels faster than one: 1.7 ms instead of 2.1 ms
// for 400 x 400 pixels. The mean of filtered channels differs from the color image by at most one level.
void upload_textures(const GlFunctions& gl, const std::vector<cv::Mat>& textures) {
  const int size = textures.empty() ? 1 : textures.front().cols;
  const int layers = std::max(1, static_cast<int>(textures.size()));
  GLuint array = 0;
  gl.GenTextures(1, &array);
  gl.BindTexture(GL_TEXTURE_2D_ARRAY, array);
  for (int level = 0; size >> level > 0; ++level) {
    gl.TexImage3D(GL_TEXTURE_2D_ARRAY, level, GL_RGBA8, size >> level, size >> level, layers, 0, GL_RGBA,
                  GL_UNSIGNED_BYTE, nullptr);
  }
  for (int layer = 0; const cv::Mat& texture : textures) {
    for (int level = 0; const cv::Mat& image : texture_pyramid(texture)) {
      gl.TexSubImage3D(GL_TEXTURE_2D_ARRAY, level, 0, 0, layer, image.cols, image.rows, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                       image.data);
      ++level;
    }
    ++layer;
  }
  gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  check_gl(gl, "copying the textures to the context");
}

namespace {

/// Creates the texture of the map and binds a framebuffer with it.
void make_map(const GlFunctions& gl, int texels) {
  GLuint texture = 0, framebuffer = 0;
  gl.GenTextures(1, &texture);
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, texels, texels, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  // The sampler averages four comparisons. Outside the map everything is lit, because its border has the maximum depth.
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
        fmt::format("OpenGL cannot create a shadow map of {} x {} texels (status {:#06x})", texels, texels, status));
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
  check_gl(gl, "drawing the shadow map");
  return from_W;
}

}  // namespace hedgehop::sim
