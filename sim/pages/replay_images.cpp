#include "sim/pages/replay_images.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "sim/config/whole_file.h"
#include "sim/flight/json_reader.h"
#include "sim/record/film.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kTileWidthPx = 240, kGrid = 17;
constexpr double kRateHz = 5.0, kMaxImages = 600.0;  // 600 images need about 1 MB
constexpr float kBlackM = 50.0f;                     // of a depth image, as in the film

/// The places of the cameras' images in the sheet, three per row.
struct SheetPlan {
  std::vector<cv::Rect> tiles;
  cv::Size size;
};

SheetPlan sheet_plan(const RigConfig& rig) {
  SheetPlan plan;
  int y = 0, row_height = 0, x = 0;
  for (const CameraConfig& camera : rig.cameras) {
    if (plan.tiles.size() % 3 == 0) {
      y += row_height;
      x = row_height = 0;
    }
    const int width = std::min(kTileWidthPx, camera.width_px);
    const int height = std::max(2, width * camera.height_px / camera.width_px);
    plan.tiles.emplace_back(x, y, width, height);
    x += width;
    row_height = std::max(row_height, height);
    plan.size = {std::max(plan.size.width, x), std::max(plan.size.height, y + height)};
  }
  plan.size = {(plan.size.width + 1) & ~1, (plan.size.height + 1) & ~1};
  return plan;
}

ImageChannel channel_of(const CameraConfig& camera) {
  if (camera.channel == CameraConfig::Channel::color) return ImageChannel::color;
  return camera.channel == CameraConfig::Channel::depth ? ImageChannel::depth : ImageChannel::grey;
}

cv::Mat shown(const cv::Mat& image, cv::Size size) {
  cv::Mat bytes = image, rgb, scaled;
  if (image.type() == CV_32FC1) image.convertTo(bytes, CV_8UC1, -255.0 / kBlackM, 255.0);
  if (bytes.channels() == 1) {
    cv::cvtColor(bytes, rgb, cv::COLOR_GRAY2RGB);
  } else {
    rgb = bytes;
  }
  cv::resize(rgb, scaled, size, 0, 0, cv::INTER_AREA);
  return scaled;
}

/// Rays are on the plane at depth 1 if the image has no ray beyond 60 deg of the axis, else on the unit sphere.
Json rays_of(const CameraConfig& camera) {
  const vision::camera::Camera model = camera.model();
  const Eigen::Matrix3d R_BC = camera.X_BC().linear();
  std::vector<std::optional<Eigen::Vector3d>> rays;
  for (int row = 0; row < kGrid; ++row) {
    for (int column = 0; column < kGrid; ++column) {
      const double u = -0.5 + camera.width_px * column / (kGrid - 1.0);
      const double v = -0.5 + camera.height_px * row / (kGrid - 1.0);
      rays.push_back(model.unit_ray({u, v}));
    }
  }
  const bool flat = std::ranges::all_of(rays, [](const auto& ray) { return ray && ray->z() > 0.5; });
  Json list = Json::array();
  for (const auto& ray : rays) {
    if (!ray) {
      list.push_back(nullptr);
      continue;
    }
    const Eigen::Vector3d p_B = R_BC * (flat ? Eigen::Vector3d(*ray / ray->z()) : *ray);
    list.push_back({milli(p_B.x()), milli(p_B.y()), milli(p_B.z())});
  }
  return list;
}

double vertical_fov_deg(const CameraConfig& camera) {
  const vision::camera::Camera model = camera.model();
  const double u = 0.5 * (camera.width_px - 1);
  const auto up = model.unit_ray({u, 0.0}), down = model.unit_ray({u, camera.height_px - 1.0});
  const double angle_rad = up && down ? std::acos(std::clamp(up->dot(*down), -1.0, 1.0)) : std::numbers::pi / 2.0;
  return std::clamp(angle_rad * 180.0 / std::numbers::pi, 20.0, 100.0);
}

/// The recorded poses of the vehicle.
class RecordedPoses {
 public:
  explicit RecordedPoses(const Table& trajectory) {
    for (size_t i = 0; i < columns_.size(); ++i) columns_[i] = trajectory.numbers(kNames[i]);
  }
  double end_s() const { return columns_[0].back(); }
  ChosenPose at(double t_s) const {
    const std::vector<double>& times = columns_[0];
    const auto next = std::ranges::lower_bound(times, t_s - 1e-9);
    const auto row = static_cast<size_t>(std::min(next - times.begin(), static_cast<ptrdiff_t>(times.size()) - 1));
    const auto value = [&](size_t column) { return columns_[column][row]; };
    ChosenPose pose{.X_WB = Eigen::Isometry3d::Identity(), .t_s = times[row]};
    pose.X_WB.translation() = Eigen::Vector3d(value(1), value(2), value(3));
    pose.X_WB.linear() =
        (Eigen::AngleAxisd(value(6), Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(value(5), Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(value(4), Eigen::Vector3d::UnitX()))
            .toRotationMatrix();
    return pose;
  }

 private:
  static constexpr std::array kNames = {"t_s", "north_m", "east_m", "down_m", "roll_rad", "pitch_rad", "yaw_rad"};
  std::array<std::vector<double>, kNames.size()> columns_;
};

}  // namespace

Json replay_cameras(const RigConfig& rig) {
  const SheetPlan plan = sheet_plan(rig);
  Json cameras = Json::array();
  for (size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraConfig& camera = rig.cameras[i];
    const Eigen::Isometry3d X_BC = camera.X_BC();
    const Eigen::Quaterniond q(X_BC.linear());
    const cv::Rect& tile = plan.tiles[i];
    const double width = plan.size.width, height = plan.size.height;
    cameras.push_back(
        {{"role", camera.role},
         {"p", {milli(X_BC.translation().x()), milli(X_BC.translation().y()), milli(X_BC.translation().z())}},
         {"q", {q.x(), q.y(), q.z(), q.w()}},
         {"fov_deg", brief(vertical_fov_deg(camera))},
         {"columns", kGrid},
         {"rows", kGrid},
         {"rays", rays_of(camera)},
         {"sheet", {tile.x / width, tile.y / height, tile.width / width, tile.height / height}}});
  }
  return cameras;
}

cv::Mat camera_sheet(Simulation& simulation, const ChosenPose* pose) {
  const RigConfig& rig = simulation.scenario().rig;
  if (rig.cameras.empty()) return {};
  const SheetPlan plan = sheet_plan(rig);
  cv::Mat sheet(plan.size, CV_8UC3, cv::Scalar::all(0));
  for (size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraConfig& camera = rig.cameras[i];
    const ImageChannel channel = channel_of(camera);
    const cv::Mat image =
        pose != nullptr ? simulation.image_from(camera.role, channel, *pose) : simulation.image(camera.role, channel);
    shown(image, plan.tiles[i].size()).copyTo(sheet(plan.tiles[i]));
  }
  return sheet;
}

CameraFilm camera_film(const RunRecord& run, const std::filesystem::path& folder) {
  CameraFilm made;
  if (run.trajectory.rows() == 0 || run.scenario.rig.cameras.empty()) return made;
  const std::filesystem::path file = folder / fmt::format("cameras-{}.webm", ::getpid());
  try {
    const RecordedPoses poses(run.trajectory);
    made.rate_hz = std::min(kRateHz, kMaxImages / std::max(1.0, poses.end_s()));
    Scenario scenario = run.scenario;
    scenario.seed = run.result.info.seed;
    scenario.link.reset();  // the poses are chosen
    Simulation simulation(std::move(scenario), hovering(run.scenario.rig, {}));
    Film film(file, made.rate_hz, sheet_plan(run.scenario.rig).size);
    for (int i = 0; i / made.rate_hz <= poses.end_s(); ++i) {
      const ChosenPose pose = poses.at(i / made.rate_hz);
      film.add(camera_sheet(simulation, &pose));
    }
    film.close();
    made.bytes = read_file_whole(file);
  } catch (const std::exception& error) {
    made.fault = error.what();
  }
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  return made;
}

}  // namespace hedgehop::sim
