#include "sim/simulation/libraries.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>
#include <vector>

#include "scenes/mesh/model.h"
#include "sim/collision/proximity.h"
#include "sim/flight/build.h"
#include "sim/flight/words.h"
#include "sim/libm/libm.h"

namespace hedgehop::sim {

Libraries used_libraries(const std::string& renderer) {
  std::vector<std::string> others = {
      fmt::format("Eigen {}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION), bullet_version()};
  if (const std::string importer = scenes::mesh::importer_version(); !importer.empty()) others.push_back(importer);
  others.emplace_back(build_compiler());
  return {.images = "OpenCV " + cv::getVersionString(),
          .functions = libm_version(),
          .others = fmt::format("{}", fmt::join(others, ", ")),
          .renderer = renderer};
}

std::string package_versions() {
  const Libraries used = used_libraries({});
  return fmt::format("{}, {}", library_words(used), used.others);
}

void keep_opencv_to_one_thread() {
  [[maybe_unused]] static const bool done = [] {
    cv::setNumThreads(1);
    return true;
  }();
}

}  // namespace hedgehop::sim
