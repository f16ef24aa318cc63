#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <utility>

#include "sim/cli/commands.h"
#include "sim/cli/plot_file.h"
#include "sim/config/input_error.h"
#include "sim/scenario/flight_parts.h"
#include "sim/scenario/obstacle_field.h"

namespace hedgehop::sim::cli {
namespace {

constexpr std::string_view kShapeNames[] = {"box", "cylinder", "sphere", "hull", "surface"};

/// Returns a row with the pose in W and the size of a solid. @param X_WM  pose of its frame.
std::string solid_row(const scenes::Solid& solid, const Eigen::Isometry3d& X_WM) {
  const Eigen::Isometry3d pose_W = X_WM * solid.X_WS;
  const Eigen::Quaterniond q(pose_W.linear());
  const Eigen::Vector3d p = pose_W.translation(), size_m = 2.0 * solid.half_extents_m;
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", solid.name, kShapeNames[static_cast<size_t>(solid.shape)],
                     p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z(), size_m.x(), size_m.y(), size_m.z());
}

std::string solids_csv(const scenes::Scene& scene, double t_s) {
  std::string text = "name,shape,north_m,east_m,down_m,qw,qx,qy,qz,size_x_m,size_y_m,size_z_m\n";
  for (const scenes::Solid& solid : scene.solids) text += solid_row(solid, Eigen::Isometry3d::Identity());
  for (const scenes::Mover& mover : scene.movers) {
    const Eigen::Isometry3d X_WM = scenes::X_WM(mover.motion, t_s);
    for (const scenes::Solid& solid : mover.solids) text += solid_row(solid, X_WM);
  }
  return text;
}

}  // namespace

int import_field(const ImportOptions& options) {
  const auto format = std::ranges::find(kFieldFormatNames, options.format) - std::begin(kFieldFormatNames);
  const scenes::worlds::OpenConfig config =
      read_obstacle_field(static_cast<FieldFormat>(format), options.files, options.scale);
  const scenes::Scene scene = build_part("scene", [&] { return build_scene(config, 1); });  // the seed draws textures
  if (!options.solids.empty()) write_named_file(options.solids, solids_csv(scene, options.time_s));
  const std::string text = scene_yaml(config, options.out.empty() ? "." : options.out.parent_path());
  if (options.out.empty()) {
    fmt::print("{}", text);
    return 0;
  }
  write_named_file(options.out, text);
  fmt::print("written: {}: {} static and {} moving obstacles\n", options.out.string(), scene.solids.size(),
             scene.movers.size());
  return 0;
}

}  // namespace hedgehop::sim::cli
