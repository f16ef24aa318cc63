#include "avoidance/flow_balance/side_cameras.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string>

#include "vision/flow/flow_field.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// A patch without texture counts as infinitely far, which suits open country and sky: the effect of a wall is
/// proportional to its share of the view. An average over the valid patches alone would come from off-center patches,
/// which also contain motion along the axis.
constexpr vision::flow::Missing kMissing = vision::flow::Missing::far_away;

/// The part of the overlay that shows one camera.
struct FlowTile {
  std::string role;
  cv::Mat grey;  ///< CV_8UC1
  const vision::flow::FlowField* field = nullptr;
  std::string caption;
};

/// An arrow of the compass at the image center: forward is up, right is right.
struct CompassArrow {
  Eigen::Vector2d v_H = Eigen::Vector2d::Zero();  ///< m/s
  cv::Scalar rgb;
};

constexpr double kFlowScale = 6.0;  // drawn px per px of flow
constexpr int kGapPx = 4;

void draw_caption(const FlowTile& tile, cv::Mat& image) {
  const double size = std::clamp(image.cols / 800.0, 0.3, 0.6);
  const int height = static_cast<int>(24 * size) + 8;
  image.rowRange(0, std::min(height, image.rows)).setTo(cv::Scalar(20, 24, 28));
  cv::putText(image, tile.role + "  " + tile.caption, {4, height - 8}, cv::FONT_HERSHEY_SIMPLEX, size,
              cv::Scalar(235, 235, 235), 1, cv::LINE_AA);
}

void draw_compass(std::span<const CompassArrow> arrows, double full_scale_mps, cv::Mat& image) {
  const cv::Point middle(image.cols / 2, image.rows / 2);
  const int radius = std::max(12, std::min(image.cols, image.rows) / 14);
  cv::circle(image, middle, radius, cv::Scalar(20, 24, 28), cv::FILLED, cv::LINE_AA);
  cv::circle(image, middle, radius, cv::Scalar(235, 235, 235), 1, cv::LINE_AA);
  for (const CompassArrow& arrow : arrows) {
    const Eigen::Vector2d tip = arrow.v_H * (radius / full_scale_mps);
    const cv::Point to(middle.x + static_cast<int>(std::lround(tip.y())),
                       middle.y - static_cast<int>(std::lround(tip.x())));
    cv::arrowedLine(image, middle, to, arrow.rgb, 2, cv::LINE_AA, 0, 0.25);
  }
}

/// Returns the camera images two by two with their flow vectors, captions and a compass of velocities.
/// @param full_scale_mps  velocity whose arrow has the radius of the compass, > 0.
/// @return CV_8UC3, RGB; empty if there are no tiles.
cv::Mat flow_overlay(std::span<const FlowTile> tiles, std::span<const CompassArrow> arrows, double full_scale_mps) {
  if (tiles.empty()) return {};
  int width = 0, height = 0;
  for (const FlowTile& tile : tiles) {
    width = std::max(width, tile.grey.cols);
    height = std::max(height, tile.grey.rows);
  }
  const int columns = tiles.size() > 1 ? 2 : 1, rows = static_cast<int>(tiles.size() + 1) / columns;
  cv::Mat image(rows * (height + kGapPx) - kGapPx, columns * (width + kGapPx) - kGapPx, CV_8UC3,
                cv::Scalar(20, 24, 28));
  for (size_t i = 0; i < tiles.size(); ++i) {
    const FlowTile& tile = tiles[i];
    if (tile.grey.empty()) continue;
    const int row = static_cast<int>(i) / columns, col = static_cast<int>(i) % columns;
    cv::Mat place = image({col * (width + kGapPx), row * (height + kGapPx), tile.grey.cols, tile.grey.rows});
    cv::cvtColor(tile.grey, place, cv::COLOR_GRAY2RGB);
    vision::flow::draw_flow(*tile.field, kFlowScale, place);
    draw_caption(tile, place);
  }
  draw_compass(arrows, full_scale_mps, image);
  return image;
}

}  // namespace

Needs SideCameras::needs() {
  Needs needs;
  for (const char* role : kSideRoles) needs.cameras.push_back({role, CameraNeed::Channel::grey, /*pinhole=*/true});
  needs.commands = {CommandType::velocity};
  return needs;
}

std::vector<Signal> SideCameras::signals() {
  std::vector<Signal> signals;
  for (const std::string role : kSideRoles) {
    signals.push_back({"flow_" + role + "_radps", "rad/s"});
    signals.push_back({"loom_" + role + "_per_s", "1/s"});
    signals.push_back({"valid_share_" + role, ""});
    signals.push_back({"inverse_range_" + role + "_per_m", "1/m"});
  }
  signals.push_back({"target_v_north_mps", "m/s"});
  signals.push_back({"target_v_east_mps", "m/s"});
  return signals;
}

SideCameras::SideCameras(const Setup& setup, const vision::flow::ImageInterpolationConfig& flow, bool derotate) {
  for (size_t i = 0; i < kSideCount; ++i) {
    const auto mounted = std::find_if(setup.cameras.begin(), setup.cameras.end(),
                                      [&](const MountedCamera& camera) { return camera.role == kSideRoles[i]; });
    cameras_.emplace_back(*mounted, CameraFlow::Options{flow, derotate, kMissing});
    const Eigen::Matrix3d& R_BC = mounted->X_BC.linear();
    axes_H_[i] = R_BC.col(2).head<2>();
    flows_[i] = {axes_H_[i], R_BC.col(0).head<2>()};
  }
}

void SideCameras::update(const Observation& observation) {
  now_ns_ = observation.t_ns;
  for (size_t i = 0; i < kSideCount; ++i) {
    fresh_[i] = false;
    for (const CameraFrame& frame : observation.frames) {
      if (frame.role == kSideRoles[i]) fresh_[i] |= cameras_[i].update(frame, observation.navigation.w_WB_B_est);
    }
    measures_[i] = cameras_[i].measure(observation.t_ns);
    flows_[i].flow_radps = measures_[i] ? measures_[i]->flow_radps : 0.0;
    flows_[i].loom_per_s = measures_[i] ? measures_[i]->loom_per_s : 0.0;
    if (fresh_[i] && measures_[i]) least_valid_share_ = std::min(least_valid_share_, measures_[i]->valid_share);
  }
}

std::vector<double> SideCameras::signal_values(
    const std::optional<std::array<double, kSideCount>>& inverse_ranges_per_m, const Eigen::Vector2d& v_tgt_W) const {
  std::vector<double> values;
  for (size_t i = 0; i < kSideCount; ++i) {
    const auto& measure = measures_[i];
    values.push_back(measure ? measure->flow_radps : kUnknown);
    values.push_back(measure ? measure->loom_per_s : kUnknown);
    values.push_back(measure ? measure->valid_share : kUnknown);
    values.push_back(measure && inverse_ranges_per_m ? (*inverse_ranges_per_m)[i] : kUnknown);
  }
  values.insert(values.end(), {v_tgt_W.x(), v_tgt_W.y()});
  return values;
}

cv::Mat SideCameras::annotate(const Eigen::Vector2d& v_tgt_H, const Eigen::Vector2d& v_cmd_H, double speed_mps) const {
  if (cameras_.front().image().empty()) return {};
  std::vector<FlowTile> tiles;
  for (size_t i = 0; i < kSideCount; ++i) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "Q %+.3f rad/s  L %+.3f /s", flows_[i].flow_radps, flows_[i].loom_per_s);
    tiles.push_back({kSideRoles[i], cameras_[i].image(), &cameras_[i].field(), text.data()});
  }
  const cv::Scalar blue(90, 170, 255), green(90, 230, 110);
  const std::array<CompassArrow, 2> arrows = {CompassArrow{v_tgt_H, blue}, CompassArrow{v_cmd_H, green}};
  constexpr double kMargin = 1.1;  // keeps an arrow of that speed inside the circle
  return flow_overlay(tiles, arrows, kMargin * speed_mps);
}

}  // namespace hedgehop::avoidance::flow_balance
