#include "sim/cli/flyable.h"

#include <fmt/format.h>

#include <stdexcept>

#include "sim/scenario/flight_parts.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim::cli {

std::set<std::string> require_flyable(const Order& order) {
  try {
    LoadedScenario loaded = load_flight(order.scenario, order.overrides, order.seed);
    loaded.scenario.link.reset();
    std::set<std::string> remarks(loaded.parts.files.remarks.begin(), loaded.parts.files.remarks.end());
    Simulation(std::move(loaded));
    return remarks;
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", order.scenario.string(), error.what()));
  }
}

void require_flyable_foreign(const Scenario& scenario, const Order& order) {
  Order apart = order;
  if (scenario.avoidance.is_foreign()) apart.overrides.emplace_back("avoidance.in_process=false");
  if (scenario.takeover && scenario.takeover->avoidance.is_foreign())
    apart.overrides.emplace_back("takeover.avoidance.in_process=false");
  if (apart.overrides.size() > order.overrides.size()) require_flyable(apart);
}

void require_first_flyable(const std::vector<Order>& orders) {
  if (orders.empty()) return;
  const Order& first = orders.front();
  require_flyable_foreign(load_flight(first.scenario, first.overrides, first.seed).scenario, first);
}

}  // namespace hedgehop::sim::cli
