#include "sim/record/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/config/pending_file.h"
#include "sim/fields/own_library.h"
#include "sim/fields/quantities.h"
#include "sim/record/film_encoder.h"

namespace hedgehop::sim {

class Film::Impl {
 public:
  Impl(const std::filesystem::path& file, double rate_hz, cv::Size size_px)
      : file_(file), size_px_(size_px.width & ~1, size_px.height & ~1) {
    if (!(rate_hz > 0.0) || size_px_.area() <= 0) {
      throw std::invalid_argument(fmt::format("film {}: rate {} Hz and size {} x {} must be positive", file.string(),
                                              rate_hz, size_px.width, size_px.height));
    }
    guarded([&] {
      pending_.emplace(file_);
      auto* const make = own_library_function<MakeFilmEncoder>(kFilmLibrary, kMakeFilmEncoder, "no encoder: ");
      make(pending_->path(), rate_hz, size_px_, encoder_);
    });
  }

  void add(const cv::Mat& rgb) {
    if (encoder_ == nullptr) throw std::runtime_error(fmt::format("film {} is closed", file_.string()));
    if (rgb.type() != CV_8UC3 || (rgb.cols & ~1) != size_px_.width || (rgb.rows & ~1) != size_px_.height) {
      throw std::invalid_argument(fmt::format("film {}: image must be RGB of {} x {} px, is {} x {}", file_.string(),
                                              size_px_.width, size_px_.height, rgb.cols, rgb.rows));
    }
    cv::cvtColor(rgb(cv::Rect({0, 0}, size_px_)), i420_, cv::COLOR_RGB2YUV_I420);
    any_ = true;
    guarded([&] { encoder_->add(i420_); });
  }

  void close() {
    if (encoder_ == nullptr) return;
    if (!any_) return discard();
    guarded([&] {
      encoder_->finish();
      encoder_.reset();
      pending_->publish();
    });
  }

 private:
  template <class Action>
  void guarded(Action action) {
    try {
      action();
    } catch (const std::exception& error) {
      discard();
      throw std::runtime_error(fmt::format("cannot write film {}: {}", file_.string(), error.what()));
    }
  }

  void discard() {
    encoder_.reset();
    pending_.reset();
  }

  std::filesystem::path file_;
  cv::Size size_px_;
  std::optional<PendingFile> pending_;
  std::unique_ptr<FilmEncoder> encoder_;
  cv::Mat i420_;
  bool any_ = false;
};

Film::Film(const std::filesystem::path& file_webm, double rate_hz, cv::Size size_px)
    : impl_(std::make_unique<Impl>(file_webm, rate_hz, size_px)) {}
Film::Film(Film&&) noexcept = default;
Film& Film::operator=(Film&&) noexcept = default;

Film::~Film() {
  if (impl_ == nullptr) return;
  try {
    impl_->close();
  } catch (const std::exception&) {  // callers that need the error use close()
  }
}

void Film::add(const cv::Mat& rgb) { impl_->add(rgb); }
void Film::close() { impl_->close(); }

namespace {

constexpr float kBlackDepthM = 50.0f;
constexpr int kCaptionPx = 22;
constexpr double kWidestSheet = 2.8;  // width per height, as in the pages' film.js

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
      image.convertTo(brightness, CV_8UC1, -255.0 / kBlackDepthM, 255.0);
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
  int columns = std::min(count, 3);
  // A film that is much wider than high is a thin strip on every page: two rows then.
  if (columns * tile.width > kWidestSheet * tile.height * ((count + columns - 1) / columns)) columns = (count + 1) / 2;
  const int rows = (count + columns - 1) / columns;
  cv::Mat sheet(rows * tile.height, columns * tile.width, CV_8UC3, cv::Scalar::all(24));
  for (int i = 0; i < count; ++i) {
    const avoidance::CameraFrame& frame = frames[static_cast<size_t>(i)];
    const cv::Point corner((i % columns) * tile.width, (i / columns) * tile.height);
    to_rgb(frame.image).copyTo(sheet(cv::Rect(corner, frame.image.size())));
    std::string label = frame.role;
    if (frame.image.type() == CV_32FC1) label += fmt::format(", white 0 m, black {:.0f} m", kBlackDepthM);
    for (const auto& [color, width] : {std::pair{cv::Scalar::all(0), 3}, std::pair{cv::Scalar(255, 210, 64), 1}}) {
      cv::putText(sheet, label, corner + cv::Point(8, 20), cv::FONT_HERSHEY_SIMPLEX, 0.55, color, width, cv::LINE_AA);
    }
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
