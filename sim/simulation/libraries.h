#pragma once

#include <string>

#include "sim/flight/flight.h"

/// The libraries that compute flights.
namespace hedgehop::sim {

/// Returns the versions of the libraries on which results depend. @param renderer  that draws the images; "" without
/// one.
Libraries used_libraries(const std::string& renderer);

/// Returns the packages that flights depend on, except the renderer, and the compiler: "OpenCV 4.6.0, SLEEF 3.5.1,
/// Eigen 3.4.0, Bullet 3.24, assimp 5.2.5, GNU 12.2.0".
std::string package_versions();

/// Limits OpenCV to one thread, because flights are the unit of parallelism. It runs once, because two flights must not
/// stop OpenCV's threads at the same time.
void keep_opencv_to_one_thread();

}  // namespace hedgehop::sim
