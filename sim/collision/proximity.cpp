#include "sim/collision/proximity.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/collision/ray_cast.h"
#include "sim/collision/separation.h"

namespace hedgehop::sim {
namespace {

using dynamics::HullPart;
using scenes::Solid;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding_m = 1e-9;  // by which closed-form bounds may be off, far from the origin too

void require_extents(const Eigen::Vector3d& half_extents_m, const std::string& what) {
  if (!half_extents_m.allFinite() || half_extents_m.minCoeff() <= 0.0) {
    throw std::invalid_argument(what + ": half extents must be finite and above 0");
  }
}

ConvexBody make_body(const HullPart& part, const std::string& what) {
  require_extents(part.half_extents_m, what);
  if (!part.center_B_m.allFinite()) throw std::invalid_argument(what + ": the centre must be finite");
  if (part.shape == HullPart::Shape::box) return {ConvexBody::Shape::box, part.half_extents_m};
  if (part.half_extents_m.x() != part.half_extents_m.y()) {
    throw std::invalid_argument(what + ": a cylinder's first two half extents are its radius and must be equal");
  }
  return {ConvexBody::Shape::cylinder, part.half_extents_m};
}

ConvexBody make_body(const Solid& solid) {
  const std::string what = "solid '" + solid.name + "'";
  require_extents(solid.half_extents_m, what);
  if (!solid.X_WS.matrix().allFinite()) throw std::invalid_argument(what + ": the pose must be finite");
  return {ConvexBody::Shape::box, solid.half_extents_m};
}

// Half size of the smallest box along W's axes that holds the body (of a cylinder: its enclosing box).
Eigen::Vector3d half_size_W(const ConvexBody& body, const Eigen::Matrix3d& R_WS) {
  return R_WS.cwiseAbs() * body.half_extents_m;
}

btVector3 to_bullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// Hands each solid whose box in the tree meets a volume to `visit`.
template <class Visit>
struct Collector : btDbvt::ICollide {
  explicit Collector(Visit v) : visit(std::move(v)) {}
  void Process(const btDbvtNode* leaf) override { visit(static_cast<size_t>(leaf->dataAsInt)); }
  Visit visit;
};

}  // namespace

class CollisionWorld::World {
 public:
  World(const scenes::Scene& scene, const std::vector<HullPart>& hull) : has_ground_(scene.has_ground) {
    if (hull.empty()) throw std::invalid_argument("the hull has no parts");
    for (const HullPart& part : hull) {
      parts_.push_back({make_body(part, "hull part " + std::to_string(parts_.size())), part.center_B_m});
    }
    solids_.reserve(scene.solids.size());
    for (const Solid& solid : scene.solids) solids_.push_back(make_body(solid));
    for (size_t i = 0; i < solids_.size(); ++i) place_solid(i, scene.solids[i].X_WS);
    tree_.optimizeTopDown();
  }

  Proximity query(const Eigen::Isometry3d& X_WB, double search_radius_m) {
    place_hull(X_WB);
    Proximity nearest;
    nearest.obstacle_clearance_m = search_radius_m;

    // What was nearest last time is near now: its distance narrows the search without touching the answer.
    if (last_nearest_) consider(*last_nearest_, nearest);
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(std::max(nearest.obstacle_clearance_m, 0.0) + kRounding_m);
    visit_solids(hull_box_W_.min() - reach, hull_box_W_.max() + reach, [&](size_t index) {
      if (index != last_nearest_) consider(index, nearest);
    });

    last_nearest_ = nearest.nearest_solid;
    if (!nearest.nearest_solid) nearest.obstacle_clearance_m = kInfinity;
    if (has_ground_) nearest.ground_clearance_m = ground_clearance();
    nearest.collided = nearest.obstacle_clearance_m <= 0.0 || nearest.ground_clearance_m <= 0.0;
    return nearest;
  }

  double height_above_surface(const Eigen::Vector3d& p_WB) const {
    double height_m = has_ground_ ? std::max(-p_WB.z(), 0.0) : kInfinity;
    const Eigen::Vector3d lowest_W(p_WB.x(), p_WB.y(), std::max(p_WB.z(), lowest_z_));
    visit_solids(p_WB, lowest_W, [&](size_t index) { height_m = std::min(height_m, plumb_line(p_WB, index)); });
    return height_m;
  }

  double distance_along(const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W, double reach_m) const {
    double nearest = 1.0;  // of the beam's length
    bool met = false;
    const Eigen::Vector3d end_W = p_W + reach_m * direction_W;
    if (has_ground_ && end_W.z() >= 0.0) {
      nearest = p_W.z() < 0.0 ? p_W.z() / (p_W.z() - end_W.z()) : 0.0;
      met = true;
    }
    Collector collector([&](size_t index) {
      const PlacedBody& solid = placed_solids_[index];
      const auto fraction = ray_fraction(*solid.body->bullet, solid.bullet_X_WS, p_W, end_W);
      if (!fraction) return;
      nearest = std::min(nearest, *fraction);
      met = true;
    });
    btDbvt::rayTest(tree_.m_root, to_bullet(p_W), to_bullet(end_W), collector);
    return met ? nearest * reach_m : kInfinity;
  }

 private:
  struct Part {
    ConvexBody body;
    Eigen::Vector3d center_B_m;
  };

  void place_solid(size_t index, const Eigen::Isometry3d& X_WS) {
    placed_solids_.emplace_back(solids_[index], X_WS);
    const Eigen::Vector3d center_W = X_WS.translation(), half_m = half_size_W(solids_[index], X_WS.linear());
    lowest_z_ = std::max(lowest_z_, center_W.z() + half_m.z());
    btDbvtNode* leaf = tree_.insert(btDbvtVolume::FromCE(to_bullet(center_W), to_bullet(half_m)), nullptr);
    leaf->dataAsInt = static_cast<int>(index);
  }

  void place_hull(const Eigen::Isometry3d& X_WB) {
    placed_parts_.clear();
    hull_box_W_.setEmpty();
    Eigen::Isometry3d X_WP = X_WB;
    for (const Part& part : parts_) {
      X_WP.translation() = X_WB * part.center_B_m;
      placed_parts_.emplace_back(part.body, X_WP);
      const Eigen::Vector3d half_m = half_size_W(part.body, X_WB.linear());
      hull_box_W_.extend(Eigen::AlignedBox3d(X_WP.translation() - half_m, X_WP.translation() + half_m));
    }
  }

  // Keeps the nearer of `nearest` and this solid; of two equally near ones the lower index, whatever the order.
  void consider(size_t index, Proximity& nearest) const {
    const PlacedBody& solid = placed_solids_[index];
    for (const PlacedBody& part : placed_parts_) {
      const Eigen::Vector3d center_W = part.X_WS.translation();
      const double center_distance_m = (solid.nearest(center_W) - center_W).norm();
      const double at_least_m = center_distance_m - part.body->bounding_radius_m - kRounding_m;
      if (center_distance_m > 0.0 && at_least_m > nearest.obstacle_clearance_m) continue;

      const Separation found = separate(part, solid);
      const bool first_of_equals =
          found.distance_m == nearest.obstacle_clearance_m && index < nearest.nearest_solid.value_or(solids_.size());
      if (found.distance_m < nearest.obstacle_clearance_m || first_of_equals) {
        nearest.obstacle_clearance_m = found.distance_m;
        nearest.nearest_solid = index;
        nearest.nearest_point_W = found.on_second_W;
      }
    }
  }

  double ground_clearance() const {
    double lowest_z = -kInfinity;
    for (const PlacedBody& part : placed_parts_) lowest_z = std::max(lowest_z, part.reach(Eigen::Vector3d::UnitZ()));
    return -lowest_z;
  }

  // Length of the plumb line from p_W to one solid: 0 inside, +inf when it misses. Slab by slab in the solid's frame.
  double plumb_line(const Eigen::Vector3d& p_W, size_t index) const {
    const PlacedBody& solid = placed_solids_[index];
    const Eigen::Vector3d p_S = solid.X_SW * p_W, down_S = solid.X_SW.linear().col(2);
    double enter_m = 0.0, leave_m = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
      const double half_m = solid.body->half_extents_m[axis];
      if (down_S[axis] == 0.0) {
        if (std::abs(p_S[axis]) > half_m) return kInfinity;
        continue;
      }
      const double one_m = (-half_m - p_S[axis]) / down_S[axis];
      const double other_m = (half_m - p_S[axis]) / down_S[axis];
      enter_m = std::max(enter_m, std::min(one_m, other_m));
      leave_m = std::min(leave_m, std::max(one_m, other_m));
    }
    return enter_m <= leave_m ? enter_m : kInfinity;
  }

  template <class Visit>
  void visit_solids(const Eigen::Vector3d& min_W, const Eigen::Vector3d& max_W, Visit visit) const {
    Collector<Visit> collector(std::move(visit));
    tree_.collideTV(tree_.m_root, btDbvtVolume::FromMM(to_bullet(min_W), to_bullet(max_W)), collector);
  }

  bool has_ground_;
  std::vector<Part> parts_;
  std::vector<ConvexBody> solids_;
  std::vector<PlacedBody> placed_solids_;
  btDbvt tree_;
  double lowest_z_ = -kInfinity;  // of all solids, in W
  std::optional<size_t> last_nearest_;

  // The hull at the pose of the query under way.
  std::vector<PlacedBody> placed_parts_;
  Eigen::AlignedBox3d hull_box_W_;
};

CollisionWorld::CollisionWorld(const scenes::Scene& scene, const std::vector<HullPart>& hull)
    : world_(std::make_unique<World>(scene, hull)) {}
CollisionWorld::~CollisionWorld() = default;
CollisionWorld::CollisionWorld(CollisionWorld&&) noexcept = default;
CollisionWorld& CollisionWorld::operator=(CollisionWorld&&) noexcept = default;

Proximity CollisionWorld::query(const Eigen::Isometry3d& X_WB, double search_radius_m) {
  return world_->query(X_WB, search_radius_m);
}
double CollisionWorld::height_above_surface(const Eigen::Vector3d& p_WB) const {
  return world_->height_above_surface(p_WB);
}
double CollisionWorld::distance_along(const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W,
                                      double reach_m) const {
  return world_->distance_along(p_W, direction_W, reach_m);
}

}  // namespace hedgehop::sim
