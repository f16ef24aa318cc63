#include "sim/record/film_watcher.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

constexpr float kDarkAtM = 50.0f;
constexpr int kCaptionPx = 22;

cv::Mat to_rgb(const cv::Mat& image) {
  cv::Mat rgb;
  switch (image.type()) {
    case CV_8UC3:
      return image.clone();
    case CV_8UC1:
      cv::cvtColor(image, rgb, cv::COLOR_GRAY2RGB);
      return rgb;
    default: {
      cv::Mat brightness;
      image.convertTo(brightness, CV_8UC1, -255.0 / kDarkAtM, 255.0);
      cv::cvtColor(brightness, rgb, cv::COLOR_GRAY2RGB);
      return rgb;
    }
  }
}

std::string caption_of(const ShownInstant& shown) {
  std::string text = fmt::format("{:.1f} s   {}", seconds(shown.t_ns), shown.status);
  if (std::isfinite(shown.obstacle_clearance_m)) text += fmt::format("   {:.1f} m clear", shown.obstacle_clearance_m);
  return text;
}

}  // namespace

cv::Mat contact_sheet(std::span<const avoidance::CameraFrame> frames) {
  if (frames.empty()) return {};
  cv::Size tile = frames.front().image.size();
  for (const avoidance::CameraFrame& frame : frames) {
    tile.width = std::max(tile.width, frame.image.cols);
    tile.height = std::max(tile.height, frame.image.rows);
  }
  const int count = static_cast<int>(frames.size());
  const int columns = std::min(count, 3);
  const int rows = (count + columns - 1) / columns;
  cv::Mat sheet(rows * tile.height, columns * tile.width, CV_8UC3, cv::Scalar::all(24));
  for (int i = 0; i < count; ++i) {
    const avoidance::CameraFrame& frame = frames[static_cast<size_t>(i)];
    const cv::Point corner((i % columns) * tile.width, (i / columns) * tile.height);
    to_rgb(frame.image).copyTo(sheet(cv::Rect(corner, frame.image.size())));
    std::string label = frame.role;
    if (frame.image.type() == CV_32FC1) label += fmt::format(", white 0 m, black {:.0f} m", kDarkAtM);
    cv::putText(sheet, label, corner + cv::Point(8, 20), cv::FONT_HERSHEY_SIMPLEX, 0.55, {255, 210, 64}, 1,
                cv::LINE_AA);
  }
  return sheet;
}

FilmWatcher::FilmWatcher(const FilmConfig& config, std::filesystem::path file_webm)
    : config_(config), file_(std::move(file_webm)) {}

void FilmWatcher::on_images(const ShownInstant& shown) {
  const cv::Mat source = shown.annotated.empty() ? contact_sheet(shown.frames) : shown.annotated;
  if (source.empty() || !fault_.empty()) return;
  try {
    const double scale = static_cast<double>(config_.width_px) / source.cols;
    const int height_px = static_cast<int>(source.rows * scale);
    image_.create(height_px + kCaptionPx, config_.width_px, CV_8UC3);
    cv::Mat scaled = image_.rowRange(0, height_px), caption = image_.rowRange(height_px, image_.rows);
    cv::resize(source, scaled, scaled.size(), 0, 0, cv::INTER_AREA);
    caption.setTo(cv::Scalar::all(24));
    cv::putText(caption, caption_of(shown), {8, kCaptionPx - 7}, cv::FONT_HERSHEY_SIMPLEX, 0.5, {235, 235, 235}, 1,
                cv::LINE_AA);
    if (!film_) {
      std::filesystem::create_directories(file_.parent_path());
      film_.emplace(file_, config_.rate_hz, image_.size());
    }
    film_->add(image_);
  } catch (const std::exception& error) {
    fault_ = error.what();
  }
}

void FilmWatcher::close() {
  if (!film_ || !fault_.empty()) return;
  try {
    film_->close();
  } catch (const std::exception& error) {
    fault_ = error.what();
  }
}

}  // namespace hedgehop::sim
