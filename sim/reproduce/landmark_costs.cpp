#include "sim/fields/order_statistics.h"
#include "sim/libm/random.h"
#include "sim/reproduce/calculations.h"
#include "sim/reproduce/corner_flight.h"

namespace hedgehop::sim {
namespace {

constexpr double kImageMs = 100.0;

CornerFlight flight_past(int corners) {
  CornerFlight flight = highrise_lateral_flight();
  Random random(static_cast<uint64_t>(corners));
  flight.corners_W.clear();
  for (int i = 0; i < corners; ++i) {
    const double north_m = uniform(random, -10.0, 10.0), east_m = uniform(random, -10.0, 10.0);
    flight.corners_W.emplace_back(north_m, east_m, -uniform(random, 0.0, 15.0));
  }
  flight.duration_s = 10.0;
  return flight;
}

double image_ms(int corners) {
  std::vector<double> costs_ms = fly_past_corners(flight_past(corners), {}, 1).filter_ms;
  return upper_median(costs_ms);
}

}  // namespace

Columns landmark_costs() {
  const std::vector<int> counts = {8, 16, 35, 70, 140, 280, 560, 1000};
  Columns columns;
  for (const int count : counts) {
    const double cost_ms = image_ms(count);
    columns["landmarks"].push_back(count);
    columns["image_ms"].push_back(cost_ms);
    columns["speed"].push_back(kImageMs / cost_ms);
  }
  const double growth = columns["image_ms"][2] / columns["image_ms"][0];
  columns["growth_8_to_35"].assign(counts.size(), growth);
  return columns;
}

}  // namespace hedgehop::sim
