#include "sim/pages/film_strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "sim/config/whole_file.h"
#include "sim/fields/quantities.h"
#include "sim/flight/result_io.h"
#include "sim/link/open_link.h"
#include "sim/record/film.h"
#include "sim/record/image_file.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim {
namespace {

constexpr size_t kImages = 5;
constexpr double kApartS = 0.8;  // between two images; less in short flights
constexpr int kWidthPx = 240, kCaptionPx = 16;
constexpr int kQuality = 70;           // of the JPEG: 30 to 60 kB per strip
constexpr double kSameFlightM = 1e-6;  // result.json has all digits; different flights differ by much more

struct Image {
  double t_s = 0.0;
  cv::Mat rgb;  ///< kWidthPx wide
};

/// Keeps the last images of a flight, scaled down.
class StripWatcher : public FlightWatcher {
 public:
  explicit StripWatcher(double rate_hz) : rate_hz_(rate_hz) {}

  double image_rate_hz() const override { return rate_hz_; }
  void on_images(const ShownInstant& shown) override {
    const cv::Mat source = shown.annotated.empty() ? contact_sheet(shown.frames) : shown.annotated;
    if (source.empty()) return;
    Image image{.t_s = seconds(shown.t_ns), .rgb = {}};
    const int height_px = std::max(1, static_cast<int>(std::lround(double{kWidthPx} * source.rows / source.cols)));
    cv::resize(source, image.rgb, {kWidthPx, height_px}, 0, 0, cv::INTER_AREA);
    images_.push_back(std::move(image));
    while (images_.front().t_s < images_.back().t_s - kApartS * kImages) images_.pop_front();
  }

  const std::deque<Image>& images() const { return images_; }

 private:
  double rate_hz_;
  std::deque<Image> images_;
};

/// Returns the images side by side in the order of time, each with its time before `end_s`.
cv::Mat strip(const std::deque<Image>& images, double end_s) {
  const double apart_s = std::min(kApartS, (images.back().t_s - images.front().t_s) / static_cast<double>(kImages - 1));
  cv::Mat sheet;
  for (size_t i = 0; i < kImages; ++i) {
    const double wanted_s = images.back().t_s - apart_s * static_cast<double>(kImages - 1 - i);
    const Image& image =
        *std::ranges::min_element(images, {}, [&](const Image& p) { return std::abs(p.t_s - wanted_s); });
    cv::Mat tile(image.rgb.rows + kCaptionPx, kWidthPx + 2, CV_8UC3, cv::Scalar::all(24));
    image.rgb.copyTo(tile(cv::Rect({0, 0}, image.rgb.size())));
    cv::putText(tile, fmt::format("{:.1f} s before", std::max(0.0, end_s - image.t_s)), {4, tile.rows - 4},
                cv::FONT_HERSHEY_SIMPLEX, 0.4, cv::Scalar::all(220), 1, cv::LINE_AA);
    if (sheet.empty()) {
      sheet = tile;
    } else {
      cv::hconcat(sheet, tile, sheet);
    }
  }
  return sheet;
}

/// Returns the strip. Throws std::runtime_error with the reason if there is none.
void write_film_strip(const std::filesystem::path& flight) {
  const FlightResult result = read_result(flight / "result.json").flight;
  const ClosestApproach& closest = result.closest_obstacle;
  const bool approached = std::isfinite(closest.distance_m);
  // A timeout is explained by its end, a failed check of a flight to its goal by the closest approach.
  const bool shows_end =
      result.outcome == Outcome::collided || (result.outcome != Outcome::reached && !holds(verdict_of(result)));
  if (!shows_end && !approached) throw std::runtime_error("the flight came near no obstacle");
  const double end_s = shows_end ? result.flight_time_s : closest.t_s;

  LoadedScenario loaded = load_flight(flight / "scenario.yaml");
  if (!shows_end) loaded.scenario.duration_s = end_s;
  StripWatcher watcher(loaded.scenario.film.rate_hz);
  const std::unique_ptr<OutsideAutopilot> autopilot = link::recorded_link(loaded.scenario, flight);
  const FlightResult again = Simulation(std::move(loaded), &watcher, autopilot.get()).run().result;
  const double clearance_m = again.closest_obstacle.distance_m;
  if (approached && std::abs(clearance_m - closest.distance_m) > kSameFlightM) {
    throw std::runtime_error(
        fmt::format("minimum clearance of the re-simulated flight is {:.6f} m, of the recorded one {:.6f} m",
                    clearance_m, closest.distance_m));
  }
  if (watcher.images().empty()) throw std::runtime_error("no camera image was rendered");
  write_file_whole(flight / "strip.jpg", jpeg_of(strip(watcher.images(), end_s), kQuality));
}

}  // namespace

std::vector<size_t> worst_flights(const std::vector<FlightRecord>& records, size_t count) {
  std::vector<std::pair<double, size_t>> collisions, failures, near_misses;
  for (size_t row = 0; row < records.size(); ++row) {
    const Verdict verdict = verdict_of(records[row]);
    if (verdict == Verdict::not_flown) continue;
    const FlightResult& result = records[row].result->flight;
    const double clearance_m = result.closest_obstacle.distance_m;
    if (result.outcome == Outcome::collided) {
      collisions.emplace_back(result.flight_time_s, row);
    } else if (!holds(verdict)) {
      failures.emplace_back(clearance_m, row);
    } else if (std::isfinite(clearance_m)) {
      near_misses.emplace_back(clearance_m, row);
    }
  }
  std::ranges::sort(collisions);
  std::ranges::sort(failures);
  std::ranges::sort(near_misses);
  const size_t half = (count + 1) / 2;
  failures.resize(std::min(failures.size(), std::max(count - half, count - std::min(count, collisions.size()))));
  collisions.resize(std::min(collisions.size(), count - failures.size()));
  near_misses.resize(std::min(near_misses.size(), count - failures.size() - collisions.size()));
  std::vector<size_t> rows;
  for (const auto* kind : {&collisions, &failures, &near_misses}) {
    for (const auto& [figure, row] : *kind) rows.push_back(row);
  }
  return rows;
}

std::vector<std::string> write_film_strips(const std::filesystem::path& folder,
                                           const std::vector<FlightRecord>& records, const std::vector<size_t>& rows,
                                           const std::function<void(const std::string&)>& on_begin) {
  std::vector<std::string> without;
  for (const size_t row : rows) {
    const std::string& id = records[row].order.id;
    on_begin(id);
    try {
      write_film_strip(folder / id);
    } catch (const std::exception& error) {  // the other flights must still get their strips
      without.push_back(fmt::format("{}: no film strip: {}", id, error.what()));
    }
  }
  return without;
}

}  // namespace hedgehop::sim
