#include "sim/python/bindings.h"

#include <memory>
#include <stdexcept>
#include <vector>

namespace hedgehop::python {
namespace py = pybind11;
namespace {

py::dtype type_of(const cv::Mat& image) {
  switch (image.depth()) {
    case CV_8U:
      return py::dtype::of<uint8_t>();
    case CV_32S:
      return py::dtype::of<int32_t>();
    case CV_32F:
      return py::dtype::of<float>();
    case CV_64F:
      return py::dtype::of<double>();
    default:
      throw std::invalid_argument("the image has an unsupported type");
  }
}

}  // namespace

py::array view_of(const cv::Mat& image) {
  auto held = std::make_unique<cv::Mat>(image);  // shares the memory
  const py::capsule owner(held.get(), [](void* mat) { delete static_cast<cv::Mat*>(mat); });
  const cv::Mat& mat = *held.release();
  std::vector<py::ssize_t> shape = {mat.rows, mat.cols};
  std::vector<py::ssize_t> strides = {static_cast<py::ssize_t>(mat.step[0]), static_cast<py::ssize_t>(mat.elemSize())};
  if (mat.channels() > 1) {
    shape.push_back(mat.channels());
    strides.push_back(static_cast<py::ssize_t>(mat.elemSize1()));
  }
  py::array array(type_of(mat), shape, strides, mat.data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

cv::Mat rgb_image(const py::handle& array) {
  const auto rgb = py::array_t<uint8_t, py::array::c_style>::ensure(array);
  if (!rgb || !py::isinstance<py::array_t<uint8_t>>(array) || rgb.ndim() != 3 || rgb.shape(2) != 3) {
    PyErr_Clear();
    throw std::invalid_argument("annotate() must return None or an array of rows x columns x 3 of uint8, RGB");
  }
  return cv::Mat(static_cast<int>(rgb.shape(0)), static_cast<int>(rgb.shape(1)), CV_8UC3,
                 const_cast<uint8_t*>(rgb.data()))
      .clone();
}

}  // namespace hedgehop::python
