#include "sim/render/shaders.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "sim/render/visible_chunks.h"

namespace hedgehop::sim {

namespace {

// Pixel (u, v) is at window position (u + 0.5, v + 0.5), and OpenGL's first row is the top row. The axes of C are then
// the axes of the window, and rows are read back in the order of a cv::Mat. Depth is reversed and has no far plane:
// near / z is 1 at the near plane and 0 at infinity; floats have their highest resolution near 0. The camera position
// is subtracted in two parts; the first subtraction is exact. This keeps the precision far from the origin.
constexpr const char* kSceneVertex = R"(layout(location = 0) in vec3 p_W;
layout(location = 1) in vec4 surface;
uniform vec3 camera_W, camera_low_C;
uniform mat3 rotation;
uniform vec4 lens;
#ifdef LABELS
layout(location = 2) in float label;
flat out float label_of_face;
#endif
out vec3 coordinates;  // u, v, brightness
flat out float layer;
#ifdef SHADOWS
uniform mat4 X_WM;
uniform mat4 sun_from_W;
out vec3 p_map;
#endif
void main() {
  vec3 p_C = rotation * (p_W - camera_W) - camera_low_C;
  gl_Position = vec4(lens.xy * p_C.xy + lens.zw * p_C.z, near, p_C.z);
  coordinates = surface.xyz;
  layer = surface.w;
#ifdef LABELS
  label_of_face = label;
#endif
#ifdef SHADOWS
  p_map = (sun_from_W * (X_WM * vec4(p_W, 1.0))).xyz;
#endif
}
)";

// Points deeper than the map are compared at its maximum depth, so that they are lit if the map has no caster there.
constexpr const char* kLight = R"(in vec3 coordinates;
flat in float layer;
uniform sampler2DArray textures;
#ifdef SHADOWS
in vec3 p_map;
uniform sampler2DShadow sun;
uniform float ambient;
float light() {
  const float rounding = 1e-5;
  float share = texture(sun, vec3(p_map.xy, max(p_map.z + rounding, 0.0)));
  return ambient + share * (coordinates.z - ambient);
}
#else
float light() { return coordinates.z; }
#endif
)";

constexpr const char* kColorFragment = R"(out vec4 pixel;
void main() { pixel = texture(textures, vec3(coordinates.xy, layer)) * light(); }
)";

constexpr const char* kGreyFragment = R"(out float pixel;
void main() { pixel = dot(texture(textures, vec3(coordinates.xy, layer)).rgb, vec3(light() / 3.0)); }
)";

constexpr const char* kDepthFragment = R"(out float z_C;
void main() { z_C = 1.0 / gl_FragCoord.w; }
)";

// Window rows run down, so the derivative along window y is the change to the next row.
constexpr const char* kPlaneFragment = R"(out vec4 plane;
void main() { plane = vec4(gl_FragCoord.w, dFdx(gl_FragCoord.w), dFdy(gl_FragCoord.w), 0.0); }
)";

constexpr const char* kLabelFragment = R"(flat in float label_of_face;
out int pixel;
void main() { pixel = int(label_of_face); }
)";

constexpr const char* kSunMapVertex = R"(layout(location = 0) in vec3 p_W;
uniform mat4 sun_from_W;
void main() {
  vec3 p_map = (sun_from_W * vec4(p_W, 1.0)).xyz;
  gl_Position = vec4(2.0 * p_map.xy - 1.0, p_map.z, 1.0);
}
)";

constexpr const char* kNoFragment = "void main() {}";

constexpr const char* kSkyVertex = R"(uniform mat3 rotation;
uniform vec4 lens;
out vec3 ray_W;
void main() {
  vec2 window = vec2(gl_VertexID == 2 ? 3.0 : -1.0, gl_VertexID == 1 ? 3.0 : -1.0);  // clockwise: a front face
  gl_Position = vec4(window, 0.0, 1.0);
  ray_W = rotation * vec3((window - lens.zw) / lens.xy, 1.0);
}
)";

constexpr const char* kSkyFragment = R"(in vec3 ray_W;
uniform vec3 horizon, zenith;
out vec4 pixel;
void main() {
  float up = max(-ray_W.z, 0.0) * inversesqrt(dot(ray_W, ray_W));
  pixel = vec4(mix(horizon, zenith, up), 1.0);
}
)";

GLuint compile(const GlFunctions& gl, GLenum stage, const std::string& source) {
  const std::string head = fmt::format("#version 330 core\nconst float near = {};\n", kNearPlaneM);
  const GLchar* sources[] = {head.c_str(), source.c_str()};
  const GLuint shader = gl.CreateShader(stage);
  gl.ShaderSource(shader, 2, sources, nullptr);
  gl.CompileShader(shader);
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<size_t>(length));
  throw std::runtime_error(fmt::format("a shader does not compile: {}", log));
}

Program link(const GlFunctions& gl, const std::string& vertex_source, const std::string& fragment_source) {
  Program program{.id = gl.CreateProgram()};
  for (const GLuint shader :
       {compile(gl, GL_VERTEX_SHADER, vertex_source), compile(gl, GL_FRAGMENT_SHADER, fragment_source)}) {
    gl.AttachShader(program.id, shader);
    gl.DeleteShader(shader);
  }
  gl.LinkProgram(program.id);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program.id, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) {
    std::string log(4096, '\0');
    GLsizei length = 0;
    gl.GetProgramInfoLog(program.id, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<size_t>(length));
    throw std::runtime_error(fmt::format("a shader program does not link: {}", log));
  }
  program.camera_W = gl.GetUniformLocation(program.id, "camera_W");
  program.camera_low_C = gl.GetUniformLocation(program.id, "camera_low_C");
  program.rotation = gl.GetUniformLocation(program.id, "rotation");
  program.lens = gl.GetUniformLocation(program.id, "lens");
  program.horizon = gl.GetUniformLocation(program.id, "horizon");
  program.zenith = gl.GetUniformLocation(program.id, "zenith");
  program.X_WM = gl.GetUniformLocation(program.id, "X_WM");
  program.sun_from_W = gl.GetUniformLocation(program.id, "sun_from_W");
  program.ambient = gl.GetUniformLocation(program.id, "ambient");
  program.sun = gl.GetUniformLocation(program.id, "sun");
  return program;
}

Program lit_program(const GlFunctions& gl, const char* fragment, Shadows shadows) {
  const std::string choice = shadows == Shadows::sun ? "#define SHADOWS\n" : "";
  return link(gl, choice + kSceneVertex, choice + kLight + fragment);
}

}  // namespace

Program color_program(const GlFunctions& gl, Shadows shadows) { return lit_program(gl, kColorFragment, shadows); }
Program grey_program(const GlFunctions& gl, Shadows shadows) { return lit_program(gl, kGreyFragment, shadows); }
Program depth_program(const GlFunctions& gl) { return link(gl, kSceneVertex, kDepthFragment); }
Program plane_program(const GlFunctions& gl) { return link(gl, kSceneVertex, kPlaneFragment); }
Program label_program(const GlFunctions& gl) {
  return link(gl, std::string("#define LABELS\n") + kSceneVertex, kLabelFragment);
}
Program sun_map_program(const GlFunctions& gl) { return link(gl, kSunMapVertex, kNoFragment); }
Program sky_program(const GlFunctions& gl) { return link(gl, kSkyVertex, kSkyFragment); }

}  // namespace hedgehop::sim
