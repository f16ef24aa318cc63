#pragma once

#include "tests/sim/render/ray_caster.h"
#include "tests/sim/render/small_world.h"

namespace hedgehop::sim {

/// Static boxes on a ground and boxes that move along straight lines, with ray casting at any time.
class MovingWorld {
 public:
  explicit MovingWorld(uint64_t seed) {
    std::mt19937_64 random(seed);
    for (int i = 0; i < kStatic; ++i) static_.boxes_W.push_back(random_box(random, 50.0));
    for (const Eigen::AlignedBox3d& box_W : static_.boxes_W) world_.add_box(box_W.cast<float>());
    static_.ground_half_m = 200.0;
    world_.add_ground(200.0f, 4);
    for (int i = 0; i < kMoving; ++i) add_mover(random);
  }

  const scenes::Scene& scene() const { return world_.scene; }
  /// Returns the ray caster for a time: first the static boxes, then the moving ones.
  RayCaster at(double t_s) const {
    RayCaster cast = static_;
    for (size_t i = 0; i < boxes_M_.size(); ++i) {
      const Eigen::Vector3d p_W = starts_W_[i] + t_s * velocities_W_[i];
      cast.boxes_W.emplace_back(boxes_M_[i].min() + p_W, boxes_M_[i].max() + p_W);
    }
    return cast;
  }
  /// Returns the displacement of a body of at(). @param body  as Hit::body().
  Eigen::Vector3d moved_W(int body, double dt_s) const {
    return body > kStatic ? Eigen::Vector3d(dt_s * velocities_W_[static_cast<size_t>(body - 1 - kStatic)])
                          : Eigen::Vector3d::Zero();
  }
  /// Returns whether ImageChannel::labels must show this label. For the ground, any of its tiles is valid.
  bool is_label(const Hit& hit, int label) const {
    if (hit.face < 0) return label == 0;
    if (hit.body() == 0) return label > kStatic && label <= kStatic + kTiles;
    return label == (hit.body() > kStatic ? hit.body() + kTiles : hit.body());
  }

 private:
  static constexpr int kStatic = 20, kMoving = 8, kTiles = 16;

  static Eigen::AlignedBox3d random_box(std::mt19937_64& random, double half_m) {
    const Eigen::Vector3d center(uniform(random, -half_m, half_m), uniform(random, -half_m, half_m),
                                 uniform(random, -20, -5));
    const Eigen::Vector3d half(uniform(random, 0.5, 5), uniform(random, 0.5, 5), uniform(random, 0.5, 4));
    // Corners are floats, as in the mesh.
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
  RayCaster static_;
  std::vector<Eigen::AlignedBox3d> boxes_M_;
  std::vector<Eigen::Vector3d> starts_W_, velocities_W_;
};

}  // namespace hedgehop::sim
