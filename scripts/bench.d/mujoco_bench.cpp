#include <GL/osmesa.h>
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>

#include "scripts/bench.d/drawn_scenes.h"
#include "sim/render/renderer.h"

// Color images of 400 x 400 px of the city's boxes: MuJoCo with OSMesa next to Hedgehop with OSMesa and
// with tiles, in street views. Each draws its own textures: MuJoCo a checkered one of 512 px, one light and no shadows.
namespace hedgehop::sim {
namespace {

constexpr int kImagePx = 400;
constexpr float kNearM = 0.1f, kFarM = 1000.0f;

const scenes::Scene& boxes() {
  static const scenes::Scene scene = city(300.0);
  return scene;
}

/// From W (north, east, down) to MuJoCo's world (north, west, up).
Eigen::Matrix3d R_MW() { return Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal(); }

std::string element(const scenes::Solid& solid) {
  const Eigen::Vector3d p_M = R_MW() * solid.X_WS.translation();
  const Eigen::Quaterniond attitude(R_MW() * solid.X_WS.linear());
  const Eigen::Vector3d& half_m = solid.half_extents_m;
  const bool box = solid.shape == scenes::Solid::Shape::box;
  if (!box && solid.shape != scenes::Solid::Shape::cylinder)
    throw std::runtime_error("neither a box nor a cylinder: " + solid.name);
  const std::string size =
      box ? fmt::format("{} {} {}", half_m.x(), half_m.y(), half_m.z()) : fmt::format("{} {}", half_m.x(), half_m.z());
  return fmt::format("<geom type='{}' size='{}' pos='{} {} {}' quat='{} {} {} {}' material='facade'/>\n",
                     box ? "box" : "cylinder", size, p_M.x(), p_M.y(), p_M.z(), attitude.w(), attitude.x(),
                     attitude.y(), attitude.z());
}

std::string model_text(const scenes::Scene& scene) {
  std::string text = fmt::format(
      "<mujoco><visual><global offwidth='{0}' offheight='{0}'/><quality offsamples='0'/></visual><asset>"
      "<texture name='facade' type='2d' builtin='checker' rgb1='.7 .6 .5' rgb2='.3 .3 .4' width='512' height='512'/>"
      "<material name='facade' texture='facade' texrepeat='.2 .2' texuniform='true'/></asset><worldbody>"
      "<light directional='true' castshadow='false' pos='0 0 100' dir='-.5 -.3 -.8'/><geom type='plane' size='150 150 "
      "1' material='facade'/>",
      kImagePx);
  for (const scenes::Solid& solid : scene.solids) text += element(solid);
  return text + "</worldbody></mujoco>";
}

/// MuJoCo's renderer with an OSMesa context of its own.
class Mujoco {
 public:
  Mujoco() {
    setenv("LP_NUM_THREADS", "0", /*overwrite=*/0);
    context_ = OSMesaCreateContextExt(GL_RGBA, 24, 8, 8, nullptr);
    make_current();
    mjVFS files;
    mj_defaultVFS(&files);
    const std::string text = model_text(boxes());
    if (mj_makeEmptyFileVFS(&files, "boxes.xml", static_cast<int>(text.size())) != 0)
      throw std::runtime_error("MuJoCo: no memory");
    std::copy(text.begin(), text.end(), static_cast<char*>(files.filedata[files.nfile - 1]));
    std::array<char, 1000> error{};
    model_ = mj_loadXML("boxes.xml", &files, error.data(), static_cast<int>(error.size()));
    mj_deleteVFS(&files);
    if (model_ == nullptr) throw std::runtime_error(std::string("MuJoCo: ") + error.data());
    data_ = mj_makeData(model_);
    mj_forward(model_, data_);
    mjv_defaultOption(&options_);
    mjv_defaultScene(&scene_);
    mjv_makeScene(model_, &scene_, static_cast<int>(boxes().solids.size()) + 100);
    mjv_defaultCamera(&camera_);
    mjr_defaultContext(&gl_);
    mjr_makeContext(model_, &gl_, mjFONTSCALE_100);
    mjr_setBuffer(mjFB_OFFSCREEN, &gl_);
    mjv_updateScene(model_, data_, &options_, nullptr, &camera_, mjCAT_ALL, &scene_);
    for (const mjtRndFlag off : {mjRND_SHADOW, mjRND_REFLECTION, mjRND_SKYBOX, mjRND_HAZE}) scene_.flags[off] = 0;
  }

  void make_current() {
    if (OSMesaMakeCurrent(context_, window_.data(), GL_UNSIGNED_BYTE, 4, 4) != GL_TRUE)
      throw std::runtime_error("OSMesaMakeCurrent failed");
  }

  /// Draws a color image, 90 degrees wide. The rows of the image are in OpenGL's order: the lowest is the first.
  void draw(const Eigen::Isometry3d& X_WC, cv::Mat& image) {
    make_current();
    const Eigen::Vector3f p_M = (R_MW() * X_WC.translation()).cast<float>();
    const Eigen::Vector3f forward_M = (R_MW() * X_WC.linear().col(2)).cast<float>(),
                          up_M = (R_MW() * -X_WC.linear().col(1)).cast<float>();
    for (mjvGLCamera& eye : scene_.camera) {
      Eigen::Vector3f::Map(eye.pos) = p_M;
      Eigen::Vector3f::Map(eye.forward) = forward_M;
      Eigen::Vector3f::Map(eye.up) = up_M;
      eye.frustum_center = 0.0f;
      eye.frustum_top = eye.frustum_near = kNearM;
      eye.frustum_bottom = -kNearM;
      eye.frustum_far = kFarM;
    }
    image.create(kImagePx, kImagePx, CV_8UC3);
    const mjrRect whole{0, 0, kImagePx, kImagePx};
    mjr_render(whole, &scene_, &gl_);
    mjr_readPixels(image.data, nullptr, whole, &gl_);
  }

 private:
  OSMesaContext context_ = nullptr;  // lives as long as the process, like all that MuJoCo allocates here
  std::array<uint32_t, 16> window_{};
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
  mjvOption options_{};
  mjvScene scene_{};
  mjvCamera camera_{};
  mjrContext gl_{};
};

/// Measures an image, the mean over the street views. The first image, which prepares textures, is not measured.
template <typename Draw>
void measure(benchmark::State& state, const Draw& draw) {
  const Poses poses = street_views(kFlightHeightM);
  cv::Mat image;
  draw(poses.front(), image);
  size_t k = 0;
  for (auto _ : state) draw(poses[k++ % poses.size()], image);
}

void draw_by(benchmark::State& state, RendererKind kind) {
  Renderer renderer(boxes(), Culling::frustum_and_horizon, kind, Shadows::none);
  measure(state, [&](const Eigen::Isometry3d& X_WC, cv::Mat& image) {
    renderer.draw({.camera = right_angle_pinhole(kImagePx, kImagePx), .X_WC = X_WC, .channel = ImageChannel::color},
                  image);
  });
}

void BoxesByMujoco(benchmark::State& state) {
  static Mujoco mujoco;
  measure(state, [&](const Eigen::Isometry3d& X_WC, cv::Mat& image) { mujoco.draw(X_WC, image); });
}
BENCHMARK(BoxesByMujoco)->Unit(benchmark::kMillisecond);

void BoxesByOsmesa(benchmark::State& state) { draw_by(state, RendererKind::osmesa); }
BENCHMARK(BoxesByOsmesa)->Unit(benchmark::kMillisecond);

void BoxesByTiles(benchmark::State& state) { draw_by(state, RendererKind::tiles); }
BENCHMARK(BoxesByTiles)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hedgehop::sim

BENCHMARK_MAIN();
