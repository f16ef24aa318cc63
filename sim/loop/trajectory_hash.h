#pragma once

#include <cstdint>
#include <string>

#include "dynamics/rigid_body.h"

namespace hedgehop::sim {

/// 64-bit FNV-1a over the bytes of the true states: equal hashes mean equal flights, bit for bit.
class TrajectoryHash {
 public:
  void add(const dynamics::RigidBodyState& body);
  /// 16 hexadecimal digits.
  std::string hex() const;

 private:
  void add(const double* values, int count);
  uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace hedgehop::sim
