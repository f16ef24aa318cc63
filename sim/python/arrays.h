#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

namespace hedgehop::python {

/// The image's own memory as an array that cannot be written to: rows x cols, or rows x cols x channels. It holds on to
/// the memory, which may be drawn over by the next image. Throws std::invalid_argument for an empty image.
pybind11::array view_of(const cv::Mat& image);

/// An image of a module's own, rows x cols x 3 of uint8, copied. Throws std::invalid_argument for another shape or
/// type.
cv::Mat rgb_image(const pybind11::handle& array);

/// (w, x, y, z).
inline Eigen::Vector4d wxyz(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

}  // namespace hedgehop::python
