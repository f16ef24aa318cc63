#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <vector>

#include "sim/python/bindings.h"
#include "vision/camera/camera.h"

namespace hedgehop::python {
namespace py = pybind11;
using namespace py::literals;
using avoidance::CameraNeed;
using avoidance::MountedCamera;
using namespace vision::camera;

namespace {

/// Returns the unit rays of all pixels in C, rows x cols x 3; NaN outside the image circle.
py::array_t<double> rays(const MountedCamera& camera) {
  const int rows = camera.model.height_px, cols = camera.model.width_px;
  py::array_t<double> directions({rows, cols, 3});
  auto d = directions.mutable_unchecked<3>();
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < cols; ++u) {
      const Eigen::Vector3d ray = camera.model.unit_ray({u, v}).value_or(Eigen::Vector3d::Constant(std::nan("")));
      for (int i = 0; i < 3; ++i) d(v, u, i) = ray[i];
    }
  }
  return directions;
}

/// Returns the pixels of points in C, ... x 2; NaN beyond the lens's limit.
py::array_t<double> project(const MountedCamera& camera,
                            const py::array_t<double, py::array::c_style | py::array::forcecast>& points_C_m) {
  if (points_C_m.ndim() == 0 || points_C_m.shape(points_C_m.ndim() - 1) != 3) {
    throw std::invalid_argument("points have the shape (..., 3)");
  }
  std::vector<py::ssize_t> shape(points_C_m.shape(), points_C_m.shape() + points_C_m.ndim());
  shape.back() = 2;
  py::array_t<double> pixels(shape);
  const double* point = points_C_m.data();
  double* pixel = pixels.mutable_data();
  for (const double* const end = point + points_C_m.size(); point != end; point += 3, pixel += 2) {
    Eigen::Map<Eigen::Vector2d> at(pixel);
    at = camera.model.project(Eigen::Map<const Eigen::Vector3d>(point)).value_or(kNoPixel);
  }
  return pixels;
}

py::dict parameters(const PinholeLens& l) {
  py::dict named("focal_x_px"_a = l.focal_x_px, "focal_y_px"_a = l.focal_y_px, "center_u_px"_a = l.center_u_px,
                 "center_v_px"_a = l.center_v_px, "k1"_a = l.k1, "k2"_a = l.k2, "p1"_a = l.p1, "p2"_a = l.p2,
                 "k3"_a = l.k3);
  if (l.is_rational()) named["k4"] = l.k4, named["k5"] = l.k5, named["k6"] = l.k6;
  return named;
}

py::dict parameters(const FisheyeLens& l) {
  return py::dict("focal_x_px"_a = l.focal_x_px, "focal_y_px"_a = l.focal_y_px, "center_u_px"_a = l.center_u_px,
                  "center_v_px"_a = l.center_v_px, "k1"_a = l.k1, "k2"_a = l.k2, "k3"_a = l.k3, "k4"_a = l.k4,
                  "limit_rad"_a = l.limit_rad);
}

py::dict parameters(const OcamLens& l) {
  return py::dict("direct"_a = l.direct, "center_row_px"_a = l.center_row_px, "center_col_px"_a = l.center_col_px,
                  "c"_a = l.c, "d"_a = l.d, "e"_a = l.e, "limit_px"_a = l.limit_px);
}

py::dict parameters(const UnifiedLens& l) {
  py::dict named = parameters(l.plane);
  named["xi"] = l.xi;
  return named;
}

py::dict parameters(const DoubleSphereLens& l) {
  return py::dict("focal_x_px"_a = l.focal_x_px, "focal_y_px"_a = l.focal_y_px, "center_u_px"_a = l.center_u_px,
                  "center_v_px"_a = l.center_v_px, "xi"_a = l.xi, "alpha"_a = l.alpha);
}

py::dict lens_parameters(const MountedCamera& camera) {
  return std::visit([](const auto& lens) { return parameters(lens); }, camera.model.lens);
}

}  // namespace

void bind_cameras(py::module_& native) {
  py::class_<CameraNeed> need(native, "CameraNeed", "A camera that a module requires.");
  py::enum_<CameraNeed::Channel>(need, "Channel")
      .value("grey", CameraNeed::Channel::grey)
      .value("color", CameraNeed::Channel::color)
      .value("depth", CameraNeed::Channel::depth)
      .value("corners", CameraNeed::Channel::corners);
  need.def(py::init([](std::string role, const std::string& channel, bool pinhole) {
             const std::array<std::string, 4> names = {"grey", "color", "depth", "corners"};
             const auto* const name = std::find(names.begin(), names.end(), channel);
             if (name == names.end()) {
               throw std::invalid_argument("channel '" + channel + "'; allowed: grey, color, depth, corners");
             }
             return CameraNeed{std::move(role), static_cast<CameraNeed::Channel>(name - names.begin()), pinhole};
           }),
           "role"_a, "channel"_a = "grey", "pinhole"_a = false)
      .def_readonly("role", &CameraNeed::role)
      .def_readonly("channel", &CameraNeed::channel)
      .def_readonly("pinhole", &CameraNeed::pinhole);
  py::class_<MountedCamera>(
      native, "MountedCamera",
      "A camera with its calibration and its pose. C: right, down, forward; its origin is the center "
      "of projection.")
      .def_readonly("role", &MountedCamera::role, "name of the camera in the rig")
      .def_readonly("rate_hz", &MountedCamera::rate_hz, "images per second")
      .def_property_readonly(
          "width_px", [](const MountedCamera& c) { return c.model.width_px; }, "columns of an image")
      .def_property_readonly(
          "height_px", [](const MountedCamera& c) { return c.model.height_px; }, "rows of an image")
      .def_property_readonly(
          "lens", [](const MountedCamera& c) { return c.model.lens_name(); },
          "name of the lens, such as 'distorted pinhole'")
      .def_property_readonly(
          "pinhole",
          [](const MountedCamera& c) {
            const vision::camera::PinholeCamera p = c.model.pinhole();
            return py::dict("focal_x_px"_a = p.focal_x_px, "focal_y_px"_a = p.focal_y_px,
                            "center_u_px"_a = p.center_u_px, "center_v_px"_a = p.center_v_px);
          },
          "focal lengths and principal point; ValueError for another lens")
      .def_property_readonly("lens_parameters", &lens_parameters, "parameters of any lens by name")
      .def_property_readonly(
          "X_BC", [](const MountedCamera& c) { return Eigen::Matrix4d(c.X_BC.matrix()); },
          "pose in B, 4 x 4: p_B = X_BC @ p_C")
      .def("project", &project, "points_C_m"_a,
           "pixels (u, v) of points in C, shape (..., 3) to (..., 2); NaN beyond the lens's limit; not clipped to the "
           "image")
      .def("rays", &rays, "unit rays of all pixels in C, rows x columns x 3; NaN outside the image circle");
}

}  // namespace hedgehop::python
