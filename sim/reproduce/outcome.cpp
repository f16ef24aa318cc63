#include "sim/reproduce/outcome.h"

#include <fmt/format.h>

#include <set>

#include "sim/batch/campaign_file.h"
#include "sim/batch/seeds.h"

namespace hedgehop::sim {

std::vector<Order> paper_orders(const Paper& paper, bool quick) {
  std::vector<Order> orders;
  std::vector<std::string> faults;
  for (const FlightGroup& group : flight_groups(paper)) {
    if (quick && !group.quick) continue;
    BatchOrders batch = read_batch({group.scenario}, parse_seeds(quick ? *group.quick : group.seeds), group.set);
    faults.insert(faults.end(), batch.faults.begin(), batch.faults.end());
    for (Order& order : batch.orders) {
      order.id = fmt::format("{}/seed{}", group.name, order.seed);
      order.group = group.name;
      orders.push_back(std::move(order));
    }
  }
  if (!faults.empty()) throw InputError(faults);
  return orders;
}

PaperOutcome paper_outcome(const Paper& paper, const std::filesystem::path& folder,
                           const std::vector<FlightRecord>& records) {
  PaperOutcome outcome{.paper = paper, .folder = folder, .flights = {}, .calculations = {}};
  for (const FlightRecord& record : records) outcome.flights[record.order.group].push_back(record);
  std::set<std::string> names;
  for (const PaperRow& row : paper.rows) names.insert(row.calculation);
  for (const PaperChart& chart : paper.charts) {
    for (const PaperSeries& series : chart.series) {
      if (const auto* calculated = std::get_if<CalculationSeries>(&series)) names.insert(calculated->calculation);
    }
  }
  names.erase("");
  for (const std::string& name : names) outcome.calculations[name] = find_calculation(name)->calculate();
  return outcome;
}

}  // namespace hedgehop::sim
