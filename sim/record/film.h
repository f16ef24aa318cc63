#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "sim/flight/flight_watcher.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// A film of a flight for browsers: VP8 in WebM, written during the flight. Encoding takes about 4 ms for a 1000 x 700
/// image and does not affect the flight. From the first film on, FFmpeg prints only errors on standard error.
class Film {
 public:
  /// The file is absent until close(): see PendingFile.
  /// @param rate_hz  images per second, > 0. @param size_px  at least 2 x 2; an odd last row or column is cropped.
  /// Throws std::runtime_error with the file and the cause if the encoder is missing or the file cannot be written. The
  /// flight may continue without a film.
  Film(const std::filesystem::path& file_webm, double rate_hz, cv::Size size_px);
  /// Finishes the film if close() was not called, and ignores errors.
  ~Film();
  Film(Film&&) noexcept;
  Film& operator=(Film&&) noexcept;

  /// Appends an image for 1 / rate_hz: CV_8UC3, RGB, of the size of the film. Throws std::invalid_argument for another
  /// image, std::runtime_error if encoding or writing fails; the file is then removed.
  void add(const cv::Mat& rgb);
  /// Completes the file and renames it. Without images, there is no file. A second call has no effect. Throws as add().
  void close();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Films a flight: the annotated images of the module, or all cameras side by side if it has none. The caption has the
/// time, the status of the module and the true clearance. An error of the film is stored for fault() and does not end
/// the flight.
class FilmWatcher : public FlightWatcher {
 public:
  FilmWatcher(const FilmConfig& config, std::filesystem::path file_webm);

  double image_rate_hz() const override { return config_.enabled ? config_.rate_hz : 0.0; }
  void on_images(const ShownInstant& shown) override;
  void close();

  /// Returns the reason why the film is missing or incomplete; empty without an error.
  const std::string& fault() const { return fault_; }

 private:
  FilmConfig config_;
  std::filesystem::path file_;
  std::optional<Film> film_;
  cv::Mat image_;
  std::string fault_;
};

/// Returns all frames side by side, three per row, or in two rows if one row is very wide, each with its role; CV_8UC3,
/// RGB. Depth is white at 0 m and black from 50 m.
cv::Mat contact_sheet(std::span<const avoidance::CameraFrame> frames);

}  // namespace hedgehop::sim
