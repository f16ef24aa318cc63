#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace hedgehop::avoidance::local_map {

/// Places that stayed unknown however long they were looked at: a plain wall cannot be matched. Routes keep out of them
/// until the memory of them fades, so that the search goes on elsewhere and ends.
/// Ours: without it, a planner that assumes unknown space to be free waits before such a wall for ever.
class ClosedCells {
 public:
  explicit ClosedCells(double keep_s = 90.0) : keep_s_(keep_s) {}

  /// Closes a disk. @param t_s  now, rising.
  void close(const Eigen::Vector2d& p_W, double radius_m, double t_s);
  /// Forgets what is older than the memory.
  void update(double t_s);
  struct Place {
    Eigen::Vector2d p_W;
    double radius_m, t_s;
  };
  const std::vector<Place>& places() const { return places_; }

 private:
  static constexpr size_t kMost = 256;  ///< the oldest are dropped beyond
  double keep_s_;
  std::vector<Place> places_;
};

}  // namespace hedgehop::avoidance::local_map
