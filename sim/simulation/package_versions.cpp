#include "sim/simulation/package_versions.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "sim/collision/bullet_version.h"
#include "sim/flight/build.h"
#include "sim/libm/libm.h"

namespace hedgehop::sim {

std::string package_versions() {
  return fmt::format("OpenCV {}, {}, Eigen {}.{}.{}, {}, {}", cv::getVersionString(), libm_version(),
                     EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, bullet_version(), build_compiler());
}

}  // namespace hedgehop::sim
