#include "sim/cli/sweep_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "sim/batch/junit.h"
#include "sim/config/utf8.h"
#include "sim/config/whole_file.h"

namespace hedgehop::sim::cli {
namespace {

constexpr size_t kMaxPageFlights = 50'000;  // a page with more could not be opened

void make_small(FlightRecord& record) {
  record.order.scenario_yaml.clear();
  record.order.inputs.clear();
  if (!record.result) return;
  record.result->flight.metrics = {};
  record.result->info.inputs.clear();
}

void write_design(const SweepRun& run, const std::vector<std::string>& design_points, size_t block) {
  nlohmann::ordered_json json{
      {"description", run.sweep.description}, {"design", ""}, {"parameters", nlohmann::ordered_json::array()}};
  std::visit([&]<class Design>(const Design&) { json["design"] = Design::kName; }, run.sweep.design);
  for (const SweepParameter& p : run.sweep.parameters) {
    json["parameters"].push_back({{"path", p.path}, {"log", p.scale == SweepParameter::Scale::log}});
  }
  if (const auto* optimize = std::get_if<OptimizeDesign>(&run.sweep.design)) {
    json["minimize"] = optimize->minimize;
    json["failure_cost"] = optimize->failure_cost;
  }
  if (block > 0) json.update({{"block", block}, {"points", design_points}});
  write_file_whole(run.out / "sweep.json", json_text(json) + "\n");
}

}  // namespace

void FlownSweep::add(const SweepConfig& sweep, const SweepOrders& orders, std::vector<FlightRecord> more, bool whole) {
  Table rows = sweep_table(sweep, orders, more);
  if (table.names().empty()) {
    table = std::move(rows);
  } else {
    table.append(std::move(rows));
  }
  for (FlightRecord& record : more) {
    if (!whole) make_small(record);
    records.push_back(std::move(record));
  }
}

EveryWrite write_sweep(const SweepRun& run, const FlownSweep& flown, const std::vector<std::string>& design_points,
                       size_t block) {
  EveryWrite files;
  files.attempt([&] {
    std::filesystem::create_directories(run.out);
    write_file_whole(run.out / (run.name + ".csv"), flown.table.csv());
  });
  files.attempt([&] { write_sqlite(run.out / (run.name + ".sqlite"), flown.table); });
  files.attempt([&] { write_design(run, design_points, block); });
  if (run.options.junit.empty()) return files;
  files.attempt([&] { write_junit(run.options.junit, junit_text(flown.records, {}, junit_origin())); });
  return files;
}

void write_sweep_page(const SweepRun& run, size_t flights) {
  if (flights > kMaxPageFlights) {
    warn(fmt::format("report.html is not written: {} flights; a page holds up to {}", flights, kMaxPageFlights));
    return;
  }
  write_campaign_page(run.out);
}

}  // namespace hedgehop::sim::cli
