#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>

namespace hedgehop::sim {

/// What FFmpeg does for a film: VP8 in WebM. It lives in a library of its own, libhedgehop_film.so, which the first
/// film loads: FFmpeg brings 180 libraries, and most flights are not filmed.
class FilmEncoder {
 public:
  virtual ~FilmEncoder() = default;
  /// Appends an image: planes of luma and chroma, as cv::COLOR_RGB2YUV_I420 leaves them. Throws std::runtime_error with
  /// FFmpeg's cause.
  virtual void add(const cv::Mat& i420) = 0;
  /// Writes what is left and closes the file. Throws as add().
  virtual void finish() = 0;
};

/// The function of that library. @param size_px  even. @param[out] made  the encoder. Throws std::runtime_error when
/// the encoder is missing or the file cannot be written.
using MakeFilmEncoder = void(const std::filesystem::path& file, double rate_hz, cv::Size size_px,
                             std::unique_ptr<FilmEncoder>& made);
constexpr const char* kFilmLibrary = "libhedgehop_film.so";
constexpr const char* kMakeFilmEncoder = "hedgehop_make_film_encoder";

}  // namespace hedgehop::sim
