#include "sim/render/sun_plan.h"

#include "sim/render/visible_chunks.h"

namespace hedgehop::sim {

namespace {

constexpr int kMinTexels = 2048, kMaxTexels = 4096;
constexpr double kMaxTexelM = 0.05;

/// Returns R_LW. L has the axes of a camera that points along the light, so that triangles have the same winding as in
/// images.
Eigen::Matrix3d sun_axes(const Eigen::Vector3f& to_sun_W) {
  const Eigen::Vector3d forward = -to_sun_W.cast<double>().normalized(), right = forward.unitOrthogonal();
  Eigen::Matrix3d R_LW;
  R_LW << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  return R_LW;
}

Eigen::AlignedBox3d bounds(const std::vector<scenes::Chunk>& chunks, const Eigen::Matrix3d& R_LW) {
  Eigen::AlignedBox3d box(Eigen::Vector3d::Constant(-1.0), Eigen::Vector3d::Constant(1.0));
  if (!chunks.empty()) box.setEmpty();
  for (const scenes::Chunk& chunk : chunks) {
    for (int corner = 0; corner < 8; ++corner) {
      const auto type = static_cast<Eigen::AlignedBox3f::CornerType>(corner);
      box.extend(R_LW * chunk.box_W.corner(type).cast<double>());
    }
  }
  return box;
}

}  // namespace

SunPlan plan_sun_map(const std::vector<scenes::Chunk>& chunks, const Eigen::Vector3f& to_sun_W) {
  SunPlan plan;
  for (const scenes::Chunk& chunk : chunks) {
    if (!lies_flat(chunk) && chunk.index_count > 0) plan.casters.push_back(chunk);
  }
  const Eigen::Matrix3d R_LW = sun_axes(to_sun_W);
  const Eigen::AlignedBox3d box = bounds(plan.casters, R_LW);
  const double across_m = box.sizes().head<2>().maxCoeff();
  plan.texels = across_m > kMinTexels * kMaxTexelM ? kMaxTexels : kMinTexels;
  constexpr int kMarginTexels = 4;
  const double texel_m = across_m / (plan.texels - 2 * kMarginTexels);
  const double side_m = texel_m * plan.texels, deep_m = box.sizes().z() + 2.0 * texel_m;
  const Eigen::Vector3d scale(1.0 / side_m, 1.0 / side_m, -1.0 / deep_m);
  plan.from_W = Eigen::Translation3d(0.5, 0.5, 0.5) * Eigen::Scaling(scale) * Eigen::Translation3d(-box.center()) *
                Eigen::Affine3d(R_LW);
  return plan;
}

}  // namespace hedgehop::sim
