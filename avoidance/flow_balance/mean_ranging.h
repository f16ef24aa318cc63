#pragma once

#include "avoidance/flow_balance/ranging.h"

namespace hedgehop::avoidance::flow_balance {

/// Ranges from each camera's mean flow and loom: the nearer of the two. It knows no direction within an image, so that
/// left_once_stopped_per_m() equals nearest_per_m(). Source: [Garratt2009] sec. 4.
class MeanRanging final : public Ranging {
 public:
  void update(const SideCameras& cameras, const NavigationState& navigation) override;
  PerSide nearest_per_m() const override { return nearest_per_m_; }
  PerSide left_once_stopped_per_m(const Approach&) const override { return nearest_per_m_; }

 private:
  PerSide nearest_per_m_{};
};

}  // namespace hedgehop::avoidance::flow_balance
