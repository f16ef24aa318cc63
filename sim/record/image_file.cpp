#include "sim/record/image_file.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace hedgehop::sim {

void write_png(const std::filesystem::path& file, const cv::Mat& image) {
  cv::Mat stored = image;
  if (image.channels() == 3) cv::cvtColor(image, stored, cv::COLOR_RGB2BGR);
  bool written = false;
  try {
    written = cv::imwrite(file.string(), stored);
  } catch (const cv::Exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.err));
  }
  if (!written) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace hedgehop::sim
