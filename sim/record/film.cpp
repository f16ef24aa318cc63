#include "sim/record/film.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/record/film_encoder.h"

namespace hedgehop::sim {
namespace {

/// The library stays for the process. It is found by the run path of who holds this code.
MakeFilmEncoder* film_library() {
  void* const library = dlopen(kFilmLibrary, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error(fmt::format("there is no encoder: {}", dlerror()));
  auto* const make = reinterpret_cast<MakeFilmEncoder*>(dlsym(library, kMakeFilmEncoder));
  if (make == nullptr) throw std::runtime_error(fmt::format("the encoder is of another Hedgehop: {}", dlerror()));
  return make;
}

}  // namespace

class Film::Impl {
 public:
  Impl(const std::filesystem::path& file, double rate_hz, cv::Size size_px)
      : file_(file), part_(file.string() + ".part"), size_px_(size_px.width & ~1, size_px.height & ~1) {
    if (!(rate_hz > 0.0) || size_px_.area() <= 0) {
      throw std::invalid_argument(fmt::format("film {}: rate {} Hz and size {} x {} must be positive", file.string(),
                                              rate_hz, size_px.width, size_px.height));
    }
    guarded([&] { film_library()(part_, rate_hz, size_px_, encoder_); });
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
    if (!any_) return give_up();
    guarded([&] {
      encoder_->finish();
      encoder_.reset();
      std::filesystem::rename(part_, file_);
    });
  }

 private:
  template <class Action>
  void guarded(Action action) {
    try {
      action();
    } catch (const std::exception& error) {
      give_up();
      throw std::runtime_error(fmt::format("cannot write film {}: {}", file_.string(), error.what()));
    }
  }

  void give_up() {
    encoder_.reset();
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
  }

  std::filesystem::path file_, part_;
  cv::Size size_px_;
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
  } catch (const std::exception&) {  // close() is there for those who want to know
  }
}

void Film::add(const cv::Mat& rgb) { impl_->add(rgb); }
void Film::close() { impl_->close(); }

}  // namespace hedgehop::sim
