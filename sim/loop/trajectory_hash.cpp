#include "sim/loop/trajectory_hash.h"

#include <fmt/format.h>

#include <cstring>

namespace hedgehop::sim {

void TrajectoryHash::add(const dynamics::RigidBodyState& body) {
  add(body.p_WB.data(), 3);
  add(body.q_WB.coeffs().data(), 4);
  add(body.v_WB_B.data(), 3);
  add(body.w_WB_B.data(), 3);
}

std::string TrajectoryHash::hex() const { return fmt::format("{:016x}", hash_); }

void TrajectoryHash::add(const double* values, int count) {
  for (int i = 0; i < count; ++i) {
    unsigned char bytes[sizeof(double)];
    std::memcpy(bytes, values + i, sizeof(double));
    for (const unsigned char byte : bytes) {
      hash_ ^= byte;
      hash_ *= 0x100000001b3u;
    }
  }
}

}  // namespace hedgehop::sim
