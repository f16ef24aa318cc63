#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "sim/flight/flight_watcher.h"
#include "sim/record/film.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Films a flight: the module's annotated images, or, where it draws none, all cameras side by side; below them the
/// time, the module's status and the true clearance. What goes wrong with the film is kept for fault() and never stops
/// the flight.
class FilmWatcher : public FlightWatcher {
 public:
  FilmWatcher(const FilmConfig& config, std::filesystem::path file_webm);

  double image_rate_hz() const override { return config_.enabled ? config_.rate_hz : 0.0; }
  void on_images(const ShownInstant& shown) override;
  void close();

  /// Why there is no film, or a shorter one; empty when nothing went wrong.
  const std::string& fault() const { return fault_; }

 private:
  FilmConfig config_;
  std::filesystem::path file_;
  std::optional<Film> film_;
  cv::Mat image_;
  std::string fault_;
};

/// All frames side by side, three in a row, each with its role written in; CV_8UC3, RGB. Depth is shown as
/// brightness: white at 0 m, black at 50 m and beyond.
cv::Mat contact_sheet(std::span<const avoidance::CameraFrame> frames);

}  // namespace hedgehop::sim
