#include "sim/render/tiles/tile_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "sim/render/tiles/box_camera.h"
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

/// Returns a box in the first lane.
EightBoxes in_first_lane(const Eigen::AlignedBox3f& box) {
  EightBoxes boxes{};
  for (int i = 0; i < 3; ++i) {
    boxes.low_m[i][0] = box.min()[i];
    boxes.high_m[i][0] = box.max()[i];
  }
  return boxes;
}

/// Requests an object from memory before it is needed.
template <class Object>
void prefetch(const Object& object) {
  constexpr size_t kLineBytes = 64;
  const auto* const from = reinterpret_cast<const char*>(&object);
  for (size_t at = 0; at < sizeof(object); at += kLineBytes) __builtin_prefetch(from + at);
}

}  // namespace

TileRenderer::TileRenderer(const scenes::Scene& scene, Culling culling, Shadows shadows)
    : kernels_(chosen_kernels()),
      culling_(culling),
      geometry_(make_geometry(scene)),
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
  std::erase_if(geometry_.chunks,
                [](const scenes::Chunk& chunk) { return lies_flat(chunk) || chunk.index_count == 0; });
  upright_ = stretches_of(geometry_.chunks);
  flat_ = stretches_of(geometry_.tiles);
  queue_.reserve(std::max(geometry_.chunks.size(), geometry_.tiles.size()));
  geometry_.chunks = {};
  geometry_.tiles = {};
}

TileRenderer::Stretches TileRenderer::stretches_of(const std::vector<scenes::Chunk>& chunks) const {
  std::vector<Eigen::AlignedBox3f> boxes_W;
  for (const scenes::Chunk& chunk : chunks) boxes_W.push_back(chunk.box_W);
  Stretches stretches{BoxTree(boxes_W), {}};
  for (const uint32_t index : stretches.tree.leaves()) {
    const scenes::Chunk& chunk = chunks[index];
    stretches.of_leaf.push_back({chunk.box_W, chunk.far, chunk.index_count,
                                 facets_.range(chunk.first_index, chunk.index_count),
                                 facets_.range(chunk.far.first_index, chunk.far.index_count)});
  }
  return stretches;
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
  const BoxCamera boxes = box_camera(memory_.frame().lens, view_.world, kNearPlaneM);
  const FarDetails far_details(camera, view.X_WC);
  draw(upright_, boxes, far_details);
  draw(flat_, boxes, far_details);
  draw_movers(view);
}

void TileRenderer::draw(Facets::FacetRange facets, uint32_t index_count, uint32_t pose) {
  memory_.reserve_surfaces(facets.count);
  kernels_.draw(memory_.frame(), view_, facets.first, facets.count, pose, kNearPlaneM);
  ++count_.stretches;
  count_.triangles += index_count / 3;
}

/// Draws the stretches that the image may show, roughly from near to far, because each may hide others behind it.
void TileRenderer::draw(const Stretches& stretches, const BoxCamera& boxes, const FarDetails& far_details) {
  const std::span<const BoxTree::Node> nodes = stretches.tree.nodes();
  const Frame& frame = memory_.frame();
  const auto push_children = [&](const BoxTree::Node& node) {
    EightViews views;
    uint32_t seen = node.lanes;
    if (culling_ != Culling::none) {
      seen = kernels_.see(frame, boxes, node.boxes_W, node.lanes, culling_ == Culling::frustum, views);
    } else {
      views = {};
    }
    for (; seen != 0; seen &= seen - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(seen));
      const uint32_t child = node.children[lane];
      if ((child & BoxTree::kLeaf) != 0) {
        prefetch(stretches.of_leaf[child & ~BoxTree::kLeaf]);
      } else {
        prefetch(nodes[child]);
      }
      queue_.push(child, frame.surface_count, views.pixels[lane], views.distance2_m2[lane]);
    }
  };
  if (!nodes.empty()) push_children(nodes.front());
  while (!queue_.empty()) {
    const BoxQueue::Entry entry = queue_.pop();
    const bool tested = culling_ != Culling::frustum_and_horizon || entry.drawn == frame.surface_count;
    if (!tested && kernels_.hides_pixels(frame, entry.pixels)) continue;
    if ((entry.child & BoxTree::kLeaf) == 0) {
      push_children(nodes[entry.child]);
      continue;
    }
    const Stretch& stretch = stretches.of_leaf[entry.child & ~BoxTree::kLeaf];
    if (far_details.suffices(stretch.far, stretch.box_W)) {
      draw(stretch.far_facets, stretch.far.index_count, kWorldPose);
    } else {
      draw(stretch.facets, stretch.index_count, kWorldPose);
    }
  }
}

/// Each moving obstacle is drawn as static in its frame M, with the camera at X_MC.
void TileRenderer::draw_movers(const Viewpoint& view) {
  for (size_t mover = 0; mover < motions_.size(); ++mover) {
    const Eigen::Isometry3d X_WM = scenes::X_WM(motions_[mover], view.t_s);
    Eigen::Isometry3d X_MC = Eigen::Isometry3d::Identity();
    X_MC.linear() = X_WM.linear().transpose() * view.X_WC.linear();
    X_MC.translation() = X_WM.linear().transpose() * (view.X_WC.translation() - X_WM.translation());
    const ViewPose pose = pose_at(X_MC);
    memory_.add_pose(pose);
    const BoxCamera boxes = box_camera(memory_.frame().lens, pose, kNearPlaneM);
    const auto index = static_cast<uint32_t>(1 + mover);
    for (const scenes::Chunk& chunk : geometry_.mover_chunks[mover]) {
      EightViews views;
      const bool seen = culling_ == Culling::none || kernels_.see(memory_.frame(), boxes, in_first_lane(chunk.box_W), 1,
                                                                  culling_ == Culling::frustum, views) != 0;
      if (!seen) continue;
      draw(facets_.range(chunk.first_index, chunk.index_count), chunk.index_count, index);
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
