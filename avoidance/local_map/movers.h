#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "avoidance/local_map/stop_planner.h"

namespace hedgehop::avoidance::local_map {

/// A point of an obstacle's surface, in the plane of flight.
struct SurfacePoint {
  Eigen::Vector2d p_W;
  bool was_free;  ///< lies where free space was seen before
};

/// What moves, as a disc.
struct Mover {
  Eigen::Vector2d p_W, v_W;  ///< of its middle, at Movers' last image, m, m/s
  double radius_m = 0.0;
  double p_sigma_m = 0.0, v_sigma_mps = 0.0;  ///< 1-sigma of either component, the larger one
};

/// Finds and follows what moves: surfaces that appear in space seen to be free. Lumps of them are followed by a filter
/// of constant velocity each, and count as movers once they went on appearing and their velocity stands out of its
/// error.
/// - A mover forbids what leads into the disc where it will be: velocity obstacles, [FioriniShiller1998] sec. 3.
/// Differs: paths end in a stop, are compared with the discs for a few seconds only, and the least threat is chosen
/// where none is free of it.
class Movers {
 public:
  struct Config {
    double sigma_per_m2 = 0.002;  ///< 1-sigma of depth over its square, 1/m
    double spacing_m = 0.3;       ///< of the points: voxels
  };
  explicit Movers(const Config& config) : config_(config) {}

  /// Takes an image's points. @param eye_W  where it was taken from. @param t_s  rises from call to call.
  void update(double t_s, const Eigen::Vector2d& eye_W, std::span<const SurfacePoint> points);

  /// At the time of the last image.
  std::vector<Mover> movers() const;

 private:
  struct Lump {
    Eigen::Vector2d p_W;
    double radius_m;
    int points, appeared;
  };
  struct Track {
    Eigen::Vector4d state;  ///< p_W, v_W
    Eigen::Matrix4d covariance;
    double radius_m;
    int evidence = 1, unseen = 0;  ///< images
    bool is_mover = false;
  };

  std::vector<Lump> lumps_of(std::span<const SurfacePoint> points) const;
  void predict(double dt_s);
  void correct(Track& track, const Lump& lump, const Eigen::Vector2d& eye_W) const;
  /// Of a lump's middle: exact across the line of sight, vague along it.
  Eigen::Matrix2d covariance_m2(const Eigen::Vector2d& p_W, const Eigen::Vector2d& eye_W) const;

  Config config_;
  std::vector<Track> tracks_;
  double t_s_ = 0.0;
};

/// By how much a path comes nearer to movers than it should, at worst, m: 0 where it never does. The vehicle stands
/// where the path ends, and the movers go on, up to 4 s after the path's begin.
/// @param clearance  as of what stands still. @param t_s  when the movers are where they say.
double threat_m(std::span<const Moment> path, std::span<const Mover> movers, const Clearance& clearance, double t_s);

}  // namespace hedgehop::avoidance::local_map
