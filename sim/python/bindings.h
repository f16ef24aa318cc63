#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>

#include "avoidance/module.h"
#include "sim/simulation/simulation.h"

/// The C++ part of the Python package `hedgehop`: states, commands, modules and the simulation. Names of numbers end in
/// their units.
namespace hedgehop::python {

/// The observation of a module in Python.
struct Observation {
  int64_t t_ns = 0;
  pybind11::dict images;  ///< role: array; a view that is valid until the simulation continues
  avoidance::NavigationState navigation;
  avoidance::Goal goal;
  pybind11::dict image_t_ns;  ///< role: instant of the image
};
Observation to_python(const avoidance::Observation& observation);

/// Returns the decision from a command or a Decision. Throws std::invalid_argument for any other object.
avoidance::Decision to_decision(const pybind11::handle& answer);

/// Returns the command that a caller gives to a simulation: as of to_decision(), or a direct command.
sim::CallerCommand to_caller_command(const pybind11::handle& command);

/// Returns a module implemented by a Python object. Each call holds the lock of the interpreter. Python exceptions
/// become std::runtime_error with one line that includes the places.
/// @param instance  has `update`, and optionally `needs`, `reset`, `signals`, `metrics`, `annotate`.
std::unique_ptr<avoidance::Module> wrap_python_object(pybind11::object instance);

/// Returns a read-only array with the memory of the image: rows x cols, or rows x cols x channels. The array owns a
/// share of the memory; the next image may overwrite it. Throws std::invalid_argument for an empty image.
pybind11::array view_of(const cv::Mat& image);

/// Returns a copy of an image of a module, rows x cols x 3 of uint8. Throws std::invalid_argument for another shape or
/// type.
cv::Mat rgb_image(const pybind11::handle& array);

/// Returns (w, x, y, z).
inline Eigen::Vector4d wxyz(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

void bind_cameras(pybind11::module_& native);
void bind_states(pybind11::module_& native);
void bind_modules(pybind11::module_& native);
void bind_simulation(pybind11::module_& native);

}  // namespace hedgehop::python
