#include "sim/render/tiles/tile_renderer.h"

#include <fmt/format.h>

#include <stdexcept>

#include "sim/render/tiles/sun_depths.h"
#include "sim/render/true_flow.h"
#include "sim/render/visible_chunks.h"

namespace hedgehop::sim::tiles {

namespace {

PinholeImage lens_of(const vision::camera::PinholeCamera& camera) {
  return {camera.focal_x_px,  camera.focal_y_px,  1.0 / camera.focal_x_px, 1.0 / camera.focal_y_px,
          camera.center_u_px, camera.center_v_px, camera.width_px,         camera.height_px};
}

/// @param X_MC  pose of the camera in the frame of the facets.
ViewPose pose_at(const Eigen::Isometry3d& X_MC) {
  ViewPose pose{};
  for (int i = 0; i < 3; ++i) {
    pose.p_m[i] = X_MC.translation()[i];
    for (int k = 0; k < 3; ++k) pose.R_CW[3 * i + k] = X_MC.linear()(k, i);
  }
  return pose;
}

constexpr uint32_t kWorldPose = 0;

Box box_of(const Eigen::AlignedBox3f& box) {
  return {{box.min()[0], box.min()[1], box.min()[2]}, {box.max()[0], box.max()[1], box.max()[2]}};
}

}  // namespace

TileRenderer::TileRenderer(const scenes::Scene& scene, Culling culling, Shadows shadows)
    : kernels_(chosen_kernels()),
      culling_(culling),
      geometry_(make_geometry(scene)),
      visible_(geometry_.chunks, geometry_.tiles),
      facets_(make_facets(geometry_)),
      texels_(scene.textures),
      sky_(scene.sky),
      memory_(facets_.shapes.size()) {
  for (const scenes::Mover& mover : scene.movers) motions_.push_back(mover.motion);
  view_.shapes = facets_.shapes.data();
  view_.planes_of_facets = facets_.planes();
  view_.attributes = facets_.attributes.data();
  view_.layout = texels_.layout();
  if (shadows == Shadows::sun) {
    view_.sun = draw_sun_depths(geometry_, scene.lights, sun_depths_);
    view_.sun.blocks = make_sun_blocks(view_.sun.depths, view_.sun.texels + 2, sun_blocks_);
  }
  geometry_.vertices = {};
  geometry_.indices = {};
}

void TileRenderer::color_scene(bool color) {
  if (color) {
    view_.texels.colors = texels_.colors();
  } else {
    view_.texels.greys = texels_.greys();
  }
  for (int i = 0; i < 3; ++i) {
    view_.sky.horizon[i] = 255.0f * (color ? sky_.horizon[i] : sky_.horizon.mean());
    view_.sky.zenith[i] = 255.0f * (color ? sky_.zenith[i] : sky_.zenith.mean());
  }
}

void TileRenderer::render(const vision::camera::PinholeCamera& camera, const Viewpoint& view, Raster raster,
                          int samples, cv::Mat& out) {
  require_samples(samples);
  out.create(camera.height_px, camera.width_px, type_of(raster));
  draw_scene(camera, view, samples);
  if (raster == Raster::grey || raster == Raster::color) {
    memory_.reserve_interpolants();
    color_scene(raster == Raster::color);
  }
  kernels_.finish(view_, memory_.frame(), raster, {out.data, out.step[0]});
}

bool TileRenderer::render_flow(const vision::camera::PinholeCamera& camera, const Viewpoint& view,
                               const FlowTarget& next, cv::Mat& out) {
  out.create(camera.height_px, camera.width_px, CV_32FC2);
  draw_scene(camera, view, 1);
  const Eigen::Matrix3d R_CnW = next.X_WC.linear().transpose();
  const Eigen::Vector3d flown_W_m = next.X_WC.translation() - view.X_WC.translation();
  next_poses_.clear();
  const auto add = [&](const Eigen::Isometry3d& moved_W) {
    const Eigen::Matrix3d R_CnC = R_CnW * (moved_W.linear() * view.X_WC.linear());
    const Eigen::Vector3d p_CnC_m = R_CnW * (displacement(moved_W, view.X_WC.translation()) - flown_W_m);
    NextPose& pose = next_poses_.emplace_back();
    for (int i = 0; i < 9; ++i) pose.R_CnC[i] = R_CnC(i / 3, i % 3);
    for (int i = 0; i < 3; ++i) pose.p_CnC_m[i] = p_CnC_m[i];
  };
  add(Eigen::Isometry3d::Identity());
  for (const Eigen::Isometry3d& moved_W : next.moved_W) add(moved_W);
  kernels_.flow(memory_.frame(), next_poses_.data(), {out.data, out.step[0]});
  return true;
}

void TileRenderer::draw_scene(const vision::camera::PinholeCamera& camera, const Viewpoint& view, int samples) {
  view_.world = pose_at(view.X_WC);
  memory_.begin(lens_of(camera), samples);
  memory_.add_pose(view_.world);
  visible_.find(camera, view.X_WC, culling_, *this);
  draw_movers(view);
}

void TileRenderer::draw(const scenes::Chunk& stretch, uint32_t pose) {
  const Facets::FacetRange range = facets_.range(stretch.first_index, stretch.index_count);
  memory_.reserve_surfaces(range.count);
  kernels_.draw(memory_.frame(), view_, range.first, range.count, pose, kNearPlaneM);
  ++count_.stretches;
  count_.triangles += stretch.index_count / 3;
}

void TileRenderer::add(const scenes::Chunk& stretch) { draw(stretch, kWorldPose); }

bool TileRenderer::hides(const Eigen::AlignedBox3f& box_W) const {
  return kernels_.hides(memory_.frame(), memory_.frame().poses[kWorldPose], box_of(box_W), kNearPlaneM);
}

/// Each moving obstacle is drawn as static in its frame M, with the camera at X_MC.
void TileRenderer::draw_movers(const Viewpoint& view) {
  for (size_t mover = 0; mover < motions_.size(); ++mover) {
    const Eigen::Isometry3d X_WM = scenes::X_WM(motions_[mover], view.t_s);
    Eigen::Isometry3d X_MC = Eigen::Isometry3d::Identity();
    X_MC.linear() = X_WM.linear().transpose() * view.X_WC.linear();
    X_MC.translation() = X_WM.linear().transpose() * (view.X_WC.translation() - X_WM.translation());
    memory_.add_pose(pose_at(X_MC));
    const auto index = static_cast<uint32_t>(1 + mover);
    for (const scenes::Chunk& chunk : geometry_.mover_chunks[mover]) {
      const tiles::ViewPose& seen_from = memory_.frame().poses[index];
      const bool may_hide = culling_ != Culling::none;
      if (may_hide && kernels_.hides(memory_.frame(), seen_from, box_of(chunk.box_W), kNearPlaneM)) continue;
      draw(chunk, index);
    }
  }
}

void TileRenderer::require_samples(int samples) {
  if (samples == 1 || samples == 4) return;
  throw std::invalid_argument(
      fmt::format("{} samples per pixel are not possible; valid for renderer tiles: 1, 4", samples));
}

std::string TileRenderer::info() { return fmt::format("tiles: Hedgehop; {}", kernels_.lanes); }

}  // namespace hedgehop::sim::tiles
