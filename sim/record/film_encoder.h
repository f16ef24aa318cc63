#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>

namespace hedgehop::sim {

/// Encodes a film with FFmpeg: VP8 in WebM. The implementation is in libhedgehop_film.so, which is loaded for the first
/// film, because FFmpeg loads 180 libraries and most flights have no film.
class FilmEncoder {
 public:
  virtual ~FilmEncoder() = default;
  /// Appends an image: planes of luma and chroma, as from cv::COLOR_RGB2YUV_I420. Throws std::runtime_error with the
  /// message of FFmpeg.
  virtual void add(const cv::Mat& i420) = 0;
  /// Completes and closes the file. Throws as add().
  virtual void finish() = 0;
};

/// The function of the library. @param size_px  even. @param[out] made  the encoder.
/// Throws std::runtime_error if the encoder is missing or the file cannot be written.
using MakeFilmEncoder = void(const std::filesystem::path& file, double rate_hz, cv::Size size_px,
                             std::unique_ptr<FilmEncoder>& made);
constexpr const char* kFilmLibrary = "libhedgehop_film.so";
constexpr const char* kMakeFilmEncoder = "hedgehop_make_film_encoder";

}  // namespace hedgehop::sim
