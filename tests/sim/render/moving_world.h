#pragma once

#include "tests/sim/render/ray_caster.h"
#include "tests/sim/render/small_world.h"

namespace hedgehop::sim {

/// Boxes that stand on a ground and boxes that travel straight through them, and what rays meet of them at any time.
class MovingWorld {
 public:
  explicit MovingWorld(uint64_t seed) {
    std::mt19937_64 random(seed);
    for (int i = 0; i < kStanding; ++i) standing_.boxes_W.push_back(random_box(random, 50.0));
    for (const Eigen::AlignedBox3d& box_W : standing_.boxes_W) world_.add_box(box_W.cast<float>());
    standing_.ground_half_m = 200.0;
    world_.add_ground(200.0f, 4);
    for (int i = 0; i < kMoving; ++i) add_mover(random);
  }

  const scenes::Scene& scene() const { return world_.scene; }
  /// What stands and, behind it in the list of boxes, what moves, where it is then.
  RayCaster at(double t_s) const {
    RayCaster cast = standing_;
    for (size_t i = 0; i < boxes_M_.size(); ++i) {
      const Eigen::Vector3d p_W = starts_W_[i] + t_s * velocities_W_[i];
      cast.boxes_W.emplace_back(boxes_M_[i].min() + p_W, boxes_M_[i].max() + p_W);
    }
    return cast;
  }
  /// How far a body of at() travels. @param body  as Hit::body().
  Eigen::Vector3d moved_W(int body, double dt_s) const {
    return body > kStanding ? Eigen::Vector3d(dt_s * velocities_W_[static_cast<size_t>(body - 1 - kStanding)])
                            : Eigen::Vector3d::Zero();
  }
  /// The label that Channel::labels promises; any of the ground's tiles for the ground.
  bool is_label(const Hit& hit, int label) const {
    if (hit.face < 0) return label == 0;
    if (hit.body() == 0) return label > kStanding && label <= kStanding + kTiles;
    return label == (hit.body() > kStanding ? hit.body() + kTiles : hit.body());
  }

 private:
  static constexpr int kStanding = 20, kMoving = 8, kTiles = 16;

  static Eigen::AlignedBox3d random_box(std::mt19937_64& random, double half_m) {
    const Eigen::Vector3d center(uniform(random, -half_m, half_m), uniform(random, -half_m, half_m),
                                 uniform(random, -20, -5));
    const Eigen::Vector3d half(uniform(random, 0.5, 5), uniform(random, 0.5, 5), uniform(random, 0.5, 4));
    // Corners that floats hold, as the mesh does.
    return Eigen::AlignedBox3f((center - half).cast<float>(), (center + half).cast<float>()).cast<double>();
  }

  void add_mover(std::mt19937_64& random) {
    constexpr double kSeconds = 100.0;
    boxes_M_.push_back(random_box(random, 5.0));
    SmallWorld own;
    own.add_box(boxes_M_.back().cast<float>());
    scenes::WaypointMotion motion;
    motion.points.clear();
    Eigen::Vector3d ends_W[2];
    for (Eigen::Vector3d& end_W : ends_W) {
      end_W = {uniform(random, -60, 60), uniform(random, -60, 60), uniform(random, -20, 0)};
      motion.points.push_back({end_W.x(), end_W.y(), -end_W.z()});
    }
    motion.speed_mps = (ends_W[1] - ends_W[0]).norm() / kSeconds;
    starts_W_.push_back(ends_W[0]);
    velocities_W_.push_back((ends_W[1] - ends_W[0]) / kSeconds);
    world_.scene.movers.push_back({"mover", own.scene.meshes.front(), {}, motion});
  }

  SmallWorld world_;
  RayCaster standing_;
  std::vector<Eigen::AlignedBox3d> boxes_M_;
  std::vector<Eigen::Vector3d> starts_W_, velocities_W_;
};

}  // namespace hedgehop::sim
