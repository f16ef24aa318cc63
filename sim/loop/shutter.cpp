#include "sim/loop/shutter.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "sim/loop/pixel_levels.h"

namespace hedgehop::sim {
namespace {

constexpr double kMomentSpacingPx = 0.4;  // from 64 moments it differs by less than noise hides, see motion_blur_test

}  // namespace

Eigen::Isometry3d BodyMotion::X_WB_after(double dt_s) const {
  Eigen::Isometry3d X = X_WB;
  X.translation() += dt_s * v_WB_W;
  const Eigen::Vector3d turn = dt_s * w_WB_B;
  if (const double angle_rad = turn.norm(); angle_rad > 0.0) {
    X.linear() = X.linear() * Eigen::AngleAxisd(angle_rad, turn / angle_rad);
  }
  return X;
}

void Shutter::expose(const BodyMotion& body, double image_speed_pxps, int rows, const DrawRows& draw,
                     cv::Mat& out) const {
  if (config_.readout_s <= 0.0 && config_.shutter_s <= 0.0) {
    draw(body.X_WB, 0.0, {0, rows}, out);
    return;
  }
  int moments = 1;
  if (config_.shutter_s > 0.0) {
    const double max_moments = config_.shutter_samples;
    moments =
        static_cast<int>(std::clamp(config_.shutter_s * image_speed_pxps / kMomentSpacingPx, 0.0, max_moments - 1.0)) +
        1;
  }
  if (config_.readout_s <= 0.0) return expose_strip(body, 0.0, moments, {0, rows}, draw, out);
  const int strips = std::min(config_.readout_strips, rows);
  for (int i = 0; i < strips; ++i) {
    const cv::Range strip(i * rows / strips, (i + 1) * rows / strips);
    const double middle = strips > 1 ? 0.5 * (strip.start + strip.end - 1) / (rows - 1) : 1.0;  // 0 top row, 1 last
    expose_strip(body, -config_.readout_s * (1.0 - middle), moments, strip, draw, strip_);
    out.create(rows, strip_.cols, strip_.type());
    strip_.copyTo(out.rowRange(strip));
  }
}

void Shutter::expose_strip(const BodyMotion& body, double end_s, int moments, const cv::Range& rows,
                           const DrawRows& draw, cv::Mat& out) const {
  for (int k = 0; k < moments; ++k) {
    const double dt_s = end_s - config_.shutter_s * (k + 0.5) / moments;
    draw(body.X_WB_after(dt_s), dt_s, rows, out);
    if (moments == 1) return;
    if (k == 0) {
      out.convertTo(sums_, CV_16U);
    } else if (k < moments - 1) {
      add_levels(out, sums_);
    } else {
      mean_levels(sums_, out, moments, out);
    }
  }
}

vision::camera::Camera cut(const vision::camera::Camera& camera, const cv::Range& rows) {
  vision::camera::Camera part = camera;
  part.height_px = rows.size();
  std::visit(
      [&](auto& lens) {
        if constexpr (requires { lens.center_v_px; }) {
          lens.center_v_px -= rows.start;
        } else if constexpr (requires { lens.plane; }) {
          lens.plane.center_v_px -= rows.start;
        } else {
          lens.center_row_px -= rows.start;
        }
      },
      part.lens);
  return part;
}

}  // namespace hedgehop::sim
