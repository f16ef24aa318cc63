#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <utility>

#include "sim/cli/commands.h"
#include "sim/cli/plot_file.h"
#include "sim/config/input_error.h"
#include "sim/record/table.h"
#include "sim/scenario/flight_parts.h"
#include "sim/scenario/obstacle_field.h"

namespace hedgehop::sim::cli {
namespace {

constexpr std::string_view kShapeNames[] = {"box", "cylinder", "sphere", "hull", "surface"};

/// Adds a row with the pose in W and the size of a solid. @param X_WM  pose of its frame.
void add_row(const scenes::Solid& solid, const Eigen::Isometry3d& X_WM, fmt::memory_buffer& out) {
  const Eigen::Isometry3d pose_W = X_WM * solid.X_WS;
  const Eigen::Quaterniond q(pose_W.linear());
  CsvLine(out)
      .add(std::string_view(solid.name))
      .add(kShapeNames[static_cast<size_t>(solid.shape)])
      .add(Eigen::Vector3d(pose_W.translation()))
      .add(q.w())
      .add(Eigen::Vector3d(q.vec()))
      .add(Eigen::Vector3d(2.0 * solid.half_extents_m));
}

std::string solids_csv(const scenes::Scene& scene, double t_s) {
  fmt::memory_buffer out;
  fmt::format_to(std::back_inserter(out), "name,shape,north_m,east_m,down_m,qw,qx,qy,qz,size_x_m,size_y_m,size_z_m\n");
  for (const scenes::Solid& solid : scene.solids) add_row(solid, Eigen::Isometry3d::Identity(), out);
  for (const scenes::Mover& mover : scene.movers) {
    const Eigen::Isometry3d X_WM = scenes::X_WM(mover.motion, t_s);
    for (const scenes::Solid& solid : mover.solids) add_row(solid, X_WM, out);
  }
  return fmt::to_string(out);
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
