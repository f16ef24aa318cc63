#include "scenes/map/traffic.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "scenes/mesh/bodies.h"
#include "scenes/textures/park_textures.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::map {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMinDriveM = 40.0;    // shorter pieces have no traffic
constexpr double kGroundStepM = 20.0;  // between points of a car's path over a terrain

/// A straight piece of a street, in the direction of its points.
struct Stretch {
  Vector2d from_NE, to_NE;
  double width_m = 0.0;
};

std::vector<Stretch> straight_pieces(const std::vector<Street>& streets) {
  constexpr double kMaxBendRad = 3.0 * std::numbers::pi / 180.0;
  std::vector<Stretch> pieces;
  const auto add = [&](const Vector2d& from_NE, const Vector2d& to_NE, double width_m) {
    if ((to_NE - from_NE).norm() >= kMinDriveM) pieces.push_back({from_NE, to_NE, width_m});
  };
  for (const Street& street : streets) {
    if (!street.has_lanes) continue;
    const auto& line = street.line_NE;
    size_t first = 0;
    for (size_t i = 1; i + 1 < line.size(); ++i) {
      const Vector2d whole = line[i] - line[first], next = line[i + 1] - line[i];
      const double bend_rad = std::atan2(whole.x() * next.y() - whole.y() * next.x(), whole.dot(next));
      if (std::abs(bend_rad) <= kMaxBendRad) continue;
      add(line[first], line[i], street.width_m);
      first = i;
    }
    add(line[first], line.back(), street.width_m);
  }
  return pieces;
}

/// Returns the path of a car over the ground; nullopt if the terrain has a hole there.
std::optional<std::vector<Waypoint>> path_over(const Ground& ground, const Vector2d& from_NE, const Vector2d& to_NE) {
  std::vector<Waypoint> path;
  for (const Vector2d& p_NE : ground.divided({from_NE, to_NE}, kGroundStepM)) {
    const std::optional<double> altitude_m = ground.altitude_m(p_NE);
    if (!altitude_m) return {};
    path.push_back({p_NE.x(), p_NE.y(), *altitude_m + kStreetLiftM});
  }
  return path;
}

Mover car(const std::string& name, double heading_rad, uint32_t paint) {
  constexpr double kLengthM = 4.4, kWidthM = 1.75, kTopM = 1.45, kBodyM = 0.92;
  const double l = 0.5 * kLengthM, w = 0.5 * kWidthM;
  Mover mover{.name = name, .mesh = {}, .solids = {}, .motion = {}};
  mesh::MeshBuilder mesh("opaque");
  mesh.begin_instance(name, SemanticClass::vehicle);
  mesh.begin_chunk(false);
  const Eigen::Isometry3d X_MK(Eigen::AngleAxisd(heading_rad, Vector3d::UnitZ()));
  const auto add_part = [&](const Eigen::AlignedBox3d& box_K, uint32_t texture) {
    mesh::add_box(box_K, X_MK, {texture, textures::kVehicleTileM}, mesh);
    mover.solids.push_back(mesh::solid_of(name, box_K, X_MK));
  };
  add_part({Vector3d(-l, -w, -kBodyM), Vector3d(l, w, 0.0)}, paint);
  add_part({Vector3d(-0.8 * l, -0.9 * w, -kTopM), Vector3d(0.45 * l, 0.9 * w, -kBodyM)}, paint + 1);
  mover.mesh = mesh.finish();
  return mover;
}

}  // namespace

void add_traffic(const std::vector<Street>& streets, const Ground& ground, const TownTextures& town, int64_t count,
                 double max_speed_mps, uint64_t seed, std::vector<Mover>& movers) {
  std::vector<Stretch> pieces = straight_pieces(streets);
  Random random(seed);
  for (int64_t k = 1; k <= count && !pieces.empty();) {
    const auto chosen = static_cast<size_t>(uniform_index(random, static_cast<int>(pieces.size())));
    Stretch piece = pieces[chosen];
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(chosen));  // one car on each, so that none meet
    if (chance(random, 0.5)) std::swap(piece.from_NE, piece.to_NE);
    const Vector2d along = (piece.to_NE - piece.from_NE).normalized();
    const Vector2d lane = 0.25 * piece.width_m * Vector2d(-along.y(), along.x());
    std::optional<std::vector<Waypoint>> path = path_over(ground, piece.from_NE + lane, piece.to_NE + lane);
    if (!path) continue;
    const auto paint = static_cast<uint32_t>(uniform_index(random, TownTextures::kPaints));
    Mover mover = car("car " + std::to_string(k++), std::atan2(along.y(), along.x()), town.first_paint + 2 * paint);
    mover.motion = WaypointMotion{.points = std::move(*path),
                                  .speed_mps = max_speed_mps * uniform(random, 0.6, 1.0),
                                  .repeat = WaypointMotion::Repeat::back_and_forth};
    movers.push_back(std::move(mover));
  }
}

}  // namespace hedgehop::scenes::map
