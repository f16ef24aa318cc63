#include "sim/collision/bullet_version.h"

#include <LinearMath/btScalar.h>

namespace hedgehop::sim {

std::string bullet_version() {
  const int version = btGetVersion();
  return "Bullet " + std::to_string(version / 100) + "." + std::to_string(version % 100);
}

}  // namespace hedgehop::sim
