#include "sim/loop/trajectory_hash.h"

#include <fmt/format.h>

namespace hedgehop::sim {

void TrajectoryHash::add(const dynamics::RigidBodyState& body) {
  hash_.add({body.p_WB.data(), 3});
  hash_.add({body.q_WB.coeffs().data(), 4});
  hash_.add({body.v_WB_B.data(), 3});
  hash_.add({body.w_WB_B.data(), 3});
}

std::string TrajectoryHash::hex() const { return fmt::format("{:016x}", hash_.value()); }

}  // namespace hedgehop::sim
