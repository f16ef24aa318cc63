#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "avoidance/flow_balance/ranging.h"

namespace hedgehop::avoidance::flow_balance {

/// What is near in every direction of the plan. Between two cameras, and around the focus of expansion, flow measures
/// nothing: there a place that was measured before is remembered and carried along with the vehicle's own motion, so
/// that a building does not vanish while it passes from one camera to the next. This closes the blind spots between the
/// cameras that [Garratt2009] sec. 4.1 reports at 45 degrees. Ours.
class RangeRing {
 public:
  /// How long a place is remembered: twice the time in which it passes a blind spot 8 m away at 2 m/s.
  static constexpr int64_t kKeepNs = 4'000'000'000;

  /// Moves on in time. @param v_WB_W  estimated velocity since the last call, m/s. @param t_ns  rising.
  void carry(const Eigen::Vector2d& v_WB_W, int64_t t_ns);
  /// Takes in what a camera's columns measure now. One that shows enough parallax replaces what was remembered in its
  /// direction, any other adds to it. @param heading_rad  estimated.
  void add(const std::vector<RangeColumn>& columns, double heading_rad);

  /// The nearest place known in each sector of 5 degrees, from the vehicle, in W, m.
  std::vector<Eigen::Vector2d> places_W() const;

 private:
  static constexpr int kSectors = 72;
  struct Place {
    Eigen::Vector2d p_BP_W;
    int64_t seen_ns;
  };
  static size_t sector_of(const Eigen::Vector2d& direction_W);
  void keep_nearer(const Place& place);

  std::array<std::optional<Place>, kSectors> places_;
  int64_t now_ns_ = 0;
};

}  // namespace hedgehop::avoidance::flow_balance
