#include "sim/collision/proximity.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <LinearMath/btScalar.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/collision/convex_body.h"
#include "sim/collision/placed_hull.h"
#include "sim/collision/solid_bodies.h"
#include "sim/collision/surface_tree.h"
#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

using dynamics::HullPart;
using scenes::Solid;

constexpr double kClosedFormErrorM = 1e-9;  // error of closed-form bounds, also far from the origin

// Calls `visit` for each solid whose box in the tree intersects a volume.
template <class Visit>
struct Collector : btDbvt::ICollide {
  explicit Collector(Visit v) : visit(std::move(v)) {}
  void Process(const btDbvtNode* leaf) override { visit(static_cast<size_t>(leaf->dataAsInt)); }
  Visit visit;
};

}  // namespace

class CollisionWorld::World {
 public:
  World(const scenes::Scene& scene, const std::vector<HullPart>& hull) : has_ground_(scene.has_ground), hull_(hull) {
    size_t id = 0;
    for (size_t i = 0; i < scenes::solid_count(scene); ++i) {
      const Solid& solid = scenes::solid_at(scene, i);
      require_valid(solid);
      first_id_.push_back(id);
      if (i < scene.solids.size() && solid.shape == Solid::Shape::surface) {
        add_surface(solid, id);
        id += solid.polyhedron.faces.size();
        continue;
      }
      for (PosedBody& body : make_bodies(solid)) {
        bodies_.push_back(std::move(body));
        id_of_.push_back(id++);
      }
    }
    surfaces_.build();
    while (placed_.size() < bodies_.size() && solid_of(id_of_[placed_.size()]) < scene.solids.size()) place_static();
    grow_tree();
    place_moving(scene);
  }

  Proximity query(const Eigen::Isometry3d& X_WB, double search_radius_m, double t_s) {
    hull_.place(X_WB);
    NearestBody nearest{search_radius_m, {}, Eigen::Vector3d::Zero()};
    const auto reach_m = [&] { return std::max(nearest.clearance_m, 0.0) + kClosedFormErrorM; };
    const auto consider_other = [&](size_t id, const PlacedBody& body) {
      if (id != last_nearest_) consider(id, body, nearest);
    };

    // The previously nearest solid is still close: its distance reduces the search without changing the result.
    if (last_nearest_) consider_last(*last_nearest_, nearest);
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(reach_m());
    visit_static(hull_.box_W().min() - reach, hull_.box_W().max() + reach,
                 [&](size_t index) { consider_other(id_of_[index], placed_[index]); });
    surfaces_.visit_near([&](const Eigen::AlignedBox3d& box_W) { return hull_.min_distance_m(box_W, reach_m()); },
                         reach_m, consider_other);
    if (nearest.id) last_nearest_ = nearest.id;
    move_to(t_s);
    for (size_t index = first_moving_; index < placed_.size(); ++index)
      consider(id_of_[index], placed_[index], nearest);

    Proximity result;
    if (nearest.id) {
      result.obstacle_clearance_m = nearest.clearance_m;
      result.nearest_solid = solid_of(*nearest.id);
      result.nearest_point_W = nearest.point_W;
    }
    if (has_ground_) result.ground_clearance_m = hull_.ground_clearance_m();
    result.collided = result.obstacle_clearance_m <= 0.0 || result.ground_clearance_m <= 0.0;
    return result;
  }

  double height_above_surface(const Eigen::Vector3d& p_WB, double t_s) {
    double height_m = has_ground_ ? std::max(-p_WB.z(), 0.0) : kInfinity;
    const Eigen::Vector3d lowest_W(p_WB.x(), p_WB.y(), std::max(p_WB.z(), lowest_z_));
    visit_static(p_WB, lowest_W,
                 [&](size_t index) { height_m = std::min(height_m, height_above(p_WB, placed_[index])); });
    surfaces_.visit_along(p_WB, lowest_W, [&](size_t, const PlacedBody& body) {
      height_m = std::min(height_m, height_above(p_WB, body));
    });
    move_to(t_s);
    for (size_t index = first_moving_; index < placed_.size(); ++index) {
      const PlacedBody& body = placed_[index];
      if ((p_WB - body.X_WS.translation()).head<2>().norm() > body.body->bounding_radius_m) continue;
      height_m = std::min(height_m, height_above(p_WB, body));
    }
    return height_m;
  }

  double distance_along(const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W, double reach_m, double t_s) {
    double nearest_m = has_ground_ ? ground_along(p_W, direction_W) : kInfinity;
    const auto meet = [&](const PlacedBody& body) {
      nearest_m = std::min(nearest_m, body.body->ray_length(body.X_SW * p_W, body.X_SW.linear() * direction_W));
    };
    Collector collector([&](size_t index) { meet(placed_[index]); });
    const Eigen::Vector3d end_W = p_W + reach_m * direction_W;
    btDbvt::rayTest(tree_.m_root, to_bullet(p_W), to_bullet(end_W), collector);
    surfaces_.visit_along(p_W, end_W, [&](size_t, const PlacedBody& body) { meet(body); });
    move_to(t_s);
    for (size_t index = first_moving_; index < placed_.size(); ++index) meet(placed_[index]);
    return nearest_m <= reach_m ? nearest_m : kInfinity;
  }

 private:
  // Bodies of a mover, in the order of its solids.
  struct MoverBodies {
    scenes::Motion motion;
    size_t count = 0;
  };

  struct NearestBody {
    double clearance_m;
    std::optional<size_t> id;
    Eigen::Vector3d point_W;
  };

  // Returns the index of the solid of a body or triangle.
  size_t solid_of(size_t id) const {
    return static_cast<size_t>(std::ranges::upper_bound(first_id_, id) - first_id_.begin()) - 1;
  }

  void add_surface(const Solid& solid, size_t first_id) {
    surfaces_.add(solid, first_id);
    for (const Eigen::Vector3d& corner : solid.polyhedron.corners) {
      lowest_z_ = std::max(lowest_z_, (solid.X_WS * corner).z());
    }
  }

  // Places the next static body.
  void place_static() {
    const PlacedBody& body = place_next();
    lowest_z_ = std::max(lowest_z_, body.X_WS.translation().z() + body.half_size_W().z());
  }

  const PlacedBody& place_next() {
    const PosedBody& next = bodies_[placed_.size()];
    return placed_.emplace_back(next.body, next.X_WS);
  }

  // Adds the static bodies to the tree in a scattered order: neighbors in order would make a tree as deep as their
  // number.
  void grow_tree() {
    const size_t count = placed_.size();
    size_t step = static_cast<size_t>(0.618 * static_cast<double>(count)) + 1;
    while (std::gcd(step, count) > 1) ++step;
    for (size_t k = 0, index = 0; k < count; ++k, index = (index + step) % count) {
      const PlacedBody& body = placed_[index];
      const btDbvtVolume box = btDbvtVolume::FromCE(to_bullet(body.X_WS.translation()), to_bullet(body.half_size_W()));
      tree_.insert(box, nullptr)->dataAsInt = static_cast<int>(index);
    }
    tree_.optimizeTopDown();
  }

  // Makes room for the remaining bodies, all of movers.
  void place_moving(const scenes::Scene& scene) {
    first_moving_ = placed_.size();
    size_t solid_index = scene.solids.size();
    for (const scenes::Mover& mover : scene.movers) {
      scenes::require_motion(mover.motion);
      MoverBodies& mover_bodies = movers_.emplace_back(MoverBodies{mover.motion});
      solid_index += mover.solids.size();
      for (; placed_.size() < bodies_.size() && solid_of(id_of_[placed_.size()]) < solid_index; ++mover_bodies.count) {
        place_next();
      }
    }
  }

  // Moves the movers' bodies, unless their present place is of that time.
  void move_to(double t_s) {
    if (moved_to_s_ == t_s) return;
    size_t index = first_moving_;
    for (const MoverBodies& mover_bodies : movers_) {
      const Eigen::Isometry3d X_WM = scenes::X_WM(mover_bodies.motion, t_s);
      for (const size_t end = index + mover_bodies.count; index < end; ++index) {
        placed_[index] = {bodies_[index].body, X_WM * bodies_[index].X_WS};
      }
    }
    moved_to_s_ = t_s;
  }

  void consider_last(size_t id, NearestBody& nearest) const {
    const auto consider_it = [&](size_t, const PlacedBody& body) { consider(id, body, nearest); };
    if (surfaces_.has(id)) return surfaces_.visit_one(id, consider_it);
    consider_it(id, placed_[static_cast<size_t>(std::ranges::lower_bound(id_of_, id) - id_of_.begin())]);
  }

  // Updates `nearest` if this body is nearer. Of equally near bodies, the lower id counts in any order.
  void consider(size_t id, const PlacedBody& body, NearestBody& nearest) const {
    for (const PlacedBody& part : hull_.parts()) {
      const Eigen::Vector3d center_W = part.X_WS.translation();
      const double part_radius_m = part.body->bounding_radius_m + kClosedFormErrorM;
      const double balls_m = (body.X_WS.translation() - center_W).norm() - body.body->bounding_radius_m - part_radius_m;
      if (balls_m > std::max(nearest.clearance_m, 0.0)) continue;
      const double center_distance_m = (body.nearest(center_W) - center_W).norm();
      if (center_distance_m > 0.0 && center_distance_m - part_radius_m > nearest.clearance_m) continue;

      const Separation found = separate(part, body);
      const bool first_of_equals =
          found.distance_m == nearest.clearance_m && id < nearest.id.value_or(std::numeric_limits<size_t>::max());
      if (found.distance_m < nearest.clearance_m || first_of_equals) {
        nearest = {found.distance_m, id, found.on_second_W};
      }
    }
  }

  static double ground_along(const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W) {
    if (p_W.z() >= 0.0) return 0.0;
    return direction_W.z() > 0.0 ? -p_W.z() / direction_W.z() : kInfinity;
  }

  // Returns the height of p_W above one body: 0 inside, +inf if the vertical misses it.
  static double height_above(const Eigen::Vector3d& p_W, const PlacedBody& body) {
    return body.body->ray_length(body.X_SW * p_W, body.X_SW.linear().col(2));
  }

  template <class Visit>
  void visit_static(const Eigen::Vector3d& min_W, const Eigen::Vector3d& max_W, Visit visit) const {
    Collector<Visit> collector(std::move(visit));
    tree_.collideTV(tree_.m_root, btDbvtVolume::FromMM(to_bullet(min_W), to_bullet(max_W)), collector);
  }

  bool has_ground_;
  PlacedHull hull_;  // at the pose of the present query
  // Bodies and triangles have ids in the order of their solids, then of those of the movers.
  std::vector<size_t> first_id_;    // of each solid
  std::vector<PosedBody> bodies_;   // in that order, without the triangles of surfaces that do not move
  std::vector<size_t> id_of_;       // of each body
  std::vector<PlacedBody> placed_;  // in W; those of movers from first_moving_ on, at time moved_to_s_
  size_t first_moving_ = 0;
  std::optional<double> moved_to_s_;
  SurfaceTree surfaces_;
  std::vector<MoverBodies> movers_;
  btDbvt tree_;                         // of static bodies
  double lowest_z_ = -kInfinity;        // of static bodies and surfaces, in W
  std::optional<size_t> last_nearest_;  // id
};

CollisionWorld::CollisionWorld(const scenes::Scene& scene, const std::vector<HullPart>& hull)
    : world_(std::make_unique<World>(scene, hull)) {}
CollisionWorld::~CollisionWorld() = default;
CollisionWorld::CollisionWorld(CollisionWorld&&) noexcept = default;
CollisionWorld& CollisionWorld::operator=(CollisionWorld&&) noexcept = default;

Proximity CollisionWorld::query(const Eigen::Isometry3d& X_WB, double search_radius_m, double t_s) {
  return world_->query(X_WB, search_radius_m, t_s);
}
double CollisionWorld::height_above_surface(const Eigen::Vector3d& p_WB, double t_s) const {
  return world_->height_above_surface(p_WB, t_s);
}
double CollisionWorld::distance_along(const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W, double reach_m,
                                      double t_s) const {
  return world_->distance_along(p_W, direction_W, reach_m, t_s);
}

std::string bullet_version() {
  const int version = btGetVersion();
  return "Bullet " + std::to_string(version / 100) + "." + std::to_string(version % 100);
}

}  // namespace hedgehop::sim
