#pragma once

#include <string>

namespace hedgehop::sim {

/// The packages that flights depend on, but for what draws, and what compiled them: "OpenCV 4.6.0, SLEEF 3.5.1, Eigen
/// 3.4.0, Bullet 3.24, GNU 12.2.0".
std::string package_versions();

}  // namespace hedgehop::sim
