#include "sim/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <span>
#include <stdexcept>
#include <vector>

#include "sim/render/haze.h"
#include "sim/render/lens_faces.h"
#include "sim/render/pinhole_renderer.h"
#include "sim/render/true_flow.h"

namespace hedgehop::sim {

namespace {

/// Returns the raster of an undistorted pinhole image. Flow and classes have none: they are computed from depth and
/// labels.
Raster raster_of(ImageChannel channel) {
  switch (channel) {
    case ImageChannel::grey:
      return Raster::grey;
    case ImageChannel::color:
      return Raster::color;
    case ImageChannel::depth:
      return Raster::depth;
    case ImageChannel::labels:
      return Raster::labels;
    case ImageChannel::flow:
    case ImageChannel::semantic:
      break;
  }
  throw std::invalid_argument("unknown channel");
}

/// Returns the class of each label, as ImageChannel::semantic.
std::vector<int> classes_of_labels(const scenes::Scene& scene) {
  std::vector<int> classes{0};
  for (const scenes::Instance& instance : scenes::instances(scene)) classes.push_back(scenes::class_id(instance.kind));
  return classes;
}

}  // namespace

class Renderer::Impl {
 public:
  Impl(const scenes::Scene& scene, Culling culling, RendererKind kind, Shadows shadows)
      : pinholes_(make_pinhole_renderer(scene, culling, kind, shadows)),
        first_mover_label_(scenes::first_mover_label(scene)),
        classes_(classes_of_labels(scene)),
        sky_(scene.sky) {
    for (const scenes::Mover& mover : scene.movers) motions_.push_back(mover.motion);
  }

  void draw(const CameraView& view, cv::Mat& out) {
    check(view);
    pinholes_->start_count();
    if (view.channel == ImageChannel::flow) {
      draw_flow(view, out);
    } else if (view.channel == ImageChannel::semantic) {
      draw(view, ImageChannel::labels, out);
      for (int v = 0; v < out.rows; ++v) {
        for (int& label : std::span(out.ptr<int>(v), static_cast<size_t>(out.cols)))
          label = classes_[static_cast<size_t>(label)];
      }
    } else {
      draw(view, view.channel, out);
      if (std::isfinite(sky_.visibility_m)) add_haze(view, out);
    }
    drawn_ = {pinholes_->count().stretches, pinholes_->count().triangles};
  }

  void require_samples(int samples) { pinholes_->require_samples(samples); }
  const Drawn& drawn() const { return drawn_; }
  std::string info() { return pinholes_->info(); }

 private:
  /// The faces of a lens, and the memory for its images.
  struct Lens {
    LensFaces faces;
    cv::Mat levels, colors, planes, labels;  ///< sheets
    std::vector<Eigen::Vector3d> rays;       ///< filled by the first image that needs them
  };

  void check(const CameraView& view) {
    if (!view.camera.is_undistorted_pinhole() && find_lens(view.camera) != lenses_.end()) return check_pose(view);
    vision::camera::check(view.camera);
    check_pose(view);
  }

  static void check_pose(const CameraView& view) {
    const bool finite = view.X_WC.matrix().allFinite() && view.next.X_WC.matrix().allFinite();
    if (!finite) throw std::invalid_argument("the pose of a camera is not finite");
    if (!(view.t_s >= 0.0 && view.next.t_s >= 0.0)) throw std::invalid_argument("the time of an image is negative");
  }

  void draw(const CameraView& view, ImageChannel channel, cv::Mat& out) {
    const PinholeRenderer::Viewpoint viewpoint{view.X_WC, view.t_s};
    if (view.camera.is_undistorted_pinhole()) {
      const bool levels = channel == ImageChannel::grey || channel == ImageChannel::color;
      pinholes_->render(view.camera.pinhole(), viewpoint, raster_of(channel), levels ? view.samples : 1, out);
      return;
    }
    Lens& lens = lens_of(view.camera);
    switch (channel) {
      case ImageChannel::grey:
        render_sheet(lens.faces, viewpoint, Raster::grey, view.samples, lens.levels);
        return interpolate_levels(lens.faces, lens.levels, out);
      case ImageChannel::color:
        render_sheet(lens.faces, viewpoint, Raster::color, view.samples, lens.colors);
        return interpolate_levels(lens.faces, lens.colors, out);
      case ImageChannel::depth:
        render_sheet(lens.faces, viewpoint, Raster::planes, 1, lens.planes);
        return depths_of_planes(lens.faces, lens.planes, out);
      default:
        render_sheet(lens.faces, viewpoint, Raster::labels, 1, lens.labels);
        return labels_of_nearest(lens.faces, lens.labels, out);
    }
  }

  void add_haze(const CameraView& view, cv::Mat& image) {
    if (view.channel != ImageChannel::grey && view.channel != ImageChannel::color) return;
    draw(view, ImageChannel::depth, haze_depth_);
    const bool distorted_pinhole = depth_is_z(view.camera) && !view.camera.is_undistorted_pinhole();
    const std::span<const Eigen::Vector3d> rays =
        distorted_pinhole ? rays_of(lens_of(view.camera)) : std::span<const Eigen::Vector3d>();
    sim::add_haze(sky_, view.camera, rays, haze_depth_, image);
  }

  void render_sheet(const LensFaces& faces, const PinholeRenderer::Viewpoint& viewpoint, Raster raster, int samples,
                    cv::Mat& sheet) {
    sheet.create(faces.sheet, type_of(raster));
    for (const LensFaces::Face& face : faces.faces) {
      PinholeRenderer::Viewpoint face_viewpoint = viewpoint;
      face_viewpoint.X_WC.linear() = viewpoint.X_WC.linear() * face.R_CCf;
      cv::Mat part = sheet(cv::Rect(0, face.first_row, face.camera.width_px, face.camera.height_px));
      pinholes_->render(face.camera, face_viewpoint, raster, samples, part);
    }
  }

  void draw_flow(const CameraView& view, cv::Mat& out) {
    moved_W_.clear();
    for (const scenes::Motion& motion : motions_) {
      const Eigen::Isometry3d X_WM = scenes::X_WM(motion, view.t_s), X_WM_next = scenes::X_WM(motion, view.next.t_s);
      Eigen::Isometry3d& moved_W = moved_W_.emplace_back(X_WM_next.linear() * X_WM.linear().transpose());
      moved_W.translation() = X_WM_next.translation() - moved_W.linear() * X_WM.translation();
    }
    const bool pinhole = view.camera.is_undistorted_pinhole();
    const PinholeRenderer::FlowTarget next{view.next.X_WC, moved_W_};
    if (pinhole && pinholes_->render_flow(view.camera.pinhole(), {view.X_WC, view.t_s}, next, out)) return;
    draw(view, ImageChannel::depth, flow_depth_);
    if (!motions_.empty()) draw(view, ImageChannel::labels, flow_labels_);
    const FlowInput input{flow_depth_, flow_labels_, view.X_WC, view.next.X_WC, first_mover_label_, moved_W_};
    if (pinhole) return true_flow(view.camera.pinhole(), input, out);
    true_flow(view.camera, rays_of(lens_of(view.camera)), input, out);
  }

  std::deque<Lens>::iterator find_lens(const vision::camera::Camera& camera) {
    return std::ranges::find_if(lenses_, [&](const Lens& lens) { return lens.faces.camera == camera; });
  }

  Lens& lens_of(const vision::camera::Camera& camera) {
    if (const auto known = find_lens(camera); known != lenses_.end()) return *known;
    Lens& lens = lenses_.emplace_back();
    lens.faces.camera = camera;
    if (!camera.is_undistorted_pinhole()) lens.faces = make_lens_faces(camera);
    return lens;
  }

  static const std::vector<Eigen::Vector3d>& rays_of(Lens& lens) {
    if (lens.rays.empty()) lens.rays = all_rays(lens.faces.camera);
    return lens.rays;
  }

  std::unique_ptr<PinholeRenderer> pinholes_;
  int first_mover_label_;
  std::vector<int> classes_;             ///< of each label
  std::vector<scenes::Motion> motions_;  ///< of the movers
  std::deque<Lens> lenses_;
  scenes::Sky sky_;
  cv::Mat haze_depth_, flow_depth_, flow_labels_;
  std::vector<Eigen::Isometry3d> moved_W_;
  Drawn drawn_;
};

Renderer::Renderer(const scenes::Scene& scene, Culling culling, RendererKind kind, Shadows shadows)
    : impl_(std::make_unique<Impl>(scene, culling, kind, shadows)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

void Renderer::draw(const CameraView& view, cv::Mat& out) { impl_->draw(view, out); }
void Renderer::require_samples(int samples) { impl_->require_samples(samples); }
const Renderer::Drawn& Renderer::drawn() const { return impl_->drawn(); }
std::string Renderer::info() const { return impl_->info(); }

}  // namespace hedgehop::sim
