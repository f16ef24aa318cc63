#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "sim/export/log_sink.h"

namespace hedgehop::sim {

/// The matrices of a camera as ROS and Foxglove define them: K maps C to pixels, P the rectified frame, D are the
/// coefficients of the model.
struct LensModel {
  std::string_view model;  ///< "plumb_bob", "rational_polynomial", or the one of fisheyes
  std::vector<double> D;
  std::array<double, 9> K = {}, R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<double, 12> P = {};
};

/// Returns the matrices of a camera; nullopt for a unified, double-sphere or OCamCalib lens, which neither program
/// knows.
/// @param fisheye  the program's name of OpenCV's fisheye model.
std::optional<LensModel> lens_model(const LoggedCamera& camera, std::string_view fisheye);

}  // namespace hedgehop::sim
