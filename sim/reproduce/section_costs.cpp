#include <algorithm>
#include <chrono>
#include <opencv2/core.hpp>
#include "sim/reproduce/calculations.h"

#include "sim/fields/order_statistics.h"
#include "vision/sections/section_search.h"

namespace hedgehop::sim {
namespace {

constexpr int kRounds = 41;
constexpr double kThresholdM = 9.144, kMaxShare = 0.15;

struct Candidate {
  int side;
  vision::sections::SectionSearch search;
  std::vector<double> costs_ms = {};
};

}  // namespace

Columns section_costs() {
  cv::Mat depth_m(720, 1280, CV_32F);
  cv::RNG random(1);
  random.fill(depth_m, cv::RNG::UNIFORM, 2.0, 40.0);

  std::vector<Candidate> candidates;
  for (int side = 3; side <= 27; side += 2) {
    vision::sections::SectionGrid grid{.rows = side, .cols = side};
    if (side == 3) grid.width_share = grid.height_share = 1.0 / 3.0;  // the paper's 3 x 3 do not overlap
    candidates.push_back({side, vision::sections::SectionSearch(grid, depth_m.size())});
  }
  // Alternately, so that other load of the machine affects all equally.
  for (int round = 0; round < kRounds; ++round) {
    for (Candidate& candidate : candidates) {
      const auto start = std::chrono::steady_clock::now();
      candidate.search.choose(depth_m, kThresholdM, kMaxShare, vision::sections::UnknownDepth::free);
      const std::chrono::duration<double, std::milli> cost = std::chrono::steady_clock::now() - start;
      candidate.costs_ms.push_back(cost.count());
    }
  }

  Columns columns;
  const double least_ms = upper_median(candidates.front().costs_ms);
  for (Candidate& candidate : candidates) {
    const double cost_ms = upper_median(candidate.costs_ms);
    columns["sections"].push_back(candidate.side * candidate.side);
    columns["cost_ms"].push_back(cost_ms);
    columns["decisions_hz"].push_back(1000.0 / cost_ms);
    columns["cost_over_3x3"].push_back(cost_ms / least_ms);
  }
  return columns;
}

}  // namespace hedgehop::sim
