#pragma once

#include <string>

#include "dynamics/rigid_body.h"
#include "sim/libm/random.h"

namespace hedgehop::sim {

/// 64-bit FNV-1a over the bytes of the true states: equal hashes mean equal flights, bit for bit.
class TrajectoryHash {
 public:
  void add(const dynamics::RigidBodyState& body);
  /// 16 hexadecimal digits.
  std::string hex() const;

 private:
  Fnv1a hash_;
};

}  // namespace hedgehop::sim
