#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>

namespace hedgehop::sim {

/// A film of a flight that a browser plays: VP8 in WebM, written while the flight goes on. Encoding is tuned for speed
/// (about 4 ms for a 1000 x 700 image); nothing of it flows back into the flight.
/// FFmpeg's own messages on standard error are kept to errors from the first film on.
class Film {
 public:
  /// Opens `file_webm` aside (`.part`) until close(). @param rate_hz images a second, > 0. @param size_px at least
  /// 2 x 2; an odd last row or column is cut off. Throws std::runtime_error, naming the file and the cause, when the
  /// encoder is missing or the file cannot be written; a run may then go on without a film.
  Film(const std::filesystem::path& file_webm, double rate_hz, cv::Size size_px);
  /// Finishes the film when close() was not called; errors are then lost.
  ~Film();
  Film(Film&&) noexcept;
  Film& operator=(Film&&) noexcept;

  /// Appends an image: CV_8UC3, RGB, of the film's size (std::invalid_argument otherwise). It lasts 1 / rate_hz.
  /// Throws std::runtime_error when encoding or writing fails; the film is then given up and its file removed.
  void add(const cv::Mat& rgb);
  /// Writes what is left and gives the file its name. Without an image no file is left. A second call does nothing.
  /// Throws as add().
  void close();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hedgehop::sim
