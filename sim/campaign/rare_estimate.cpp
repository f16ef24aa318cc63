#include "sim/campaign/rare_estimate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "sim/flight/build.h"
#include "sim/scenario/flight_parts.h"
#include "sim/scenario/input_error.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kWorst = 5;

/// "chance=[{seed: 17, weight: 0.8}, ...]"; a plain seed needs none.
std::vector<std::string> chance_override(const Chance& chance) {
  if (chance == Chance::of_seed(chance.seed)) return {};
  std::vector<std::string> terms;
  for (const BlendTerm& term : chance.blend) {
    terms.push_back(fmt::format("{{seed: {}, weight: {}}}", term.seed, term.weight));
  }
  return {fmt::format("chance=[{}]", fmt::join(terms, ", "))};
}

Json level_json(const SubsetLevel& level) {
  return {{"threshold", level.threshold},
          {"probability", level.probability},
          {"correlation", level.correlation},
          {"beta", level.beta},
          {"acceptance", level.acceptance}};
}

Json run_json(const SubsetRun& run) {
  Json json{{"probability", run.probability ? Json(*run.probability) : Json(nullptr)},
            {"cov_low", run.cov_low},
            {"cov_high", run.cov_high},
            {"flights", run.samples.size()},
            {"fault", run.fault},
            {"levels", Json::array()}};
  for (const SubsetLevel& level : run.levels) json["levels"].push_back(level_json(level));
  return json;
}

std::vector<SubsetSample> all_samples(const std::vector<SubsetRun>& runs) {
  std::vector<SubsetSample> all;
  for (const SubsetRun& run : runs) all.insert(all.end(), run.samples.begin(), run.samples.end());
  return all;
}

/// The flights with the least margins, those that left no result first.
Json worst_json(std::vector<SubsetSample> samples, const EstimateRecords& records) {
  std::ranges::stable_sort(samples, {}, &SubsetSample::margin);
  Json worst = Json::array();
  for (size_t i = 0; i < std::min(kWorst, samples.size()); ++i) {
    const FlightRecord& record = records.at(flight_id(samples[i]));
    worst.push_back(
        {{"margin", samples[i].margin}, {"outcome", outcome_words(record)}, {"command", rerun_command(record.order)}});
  }
  return worst;
}

}  // namespace

double margin_of(const FlightEvent& event, const FlightRecord& record) {
  const bool of_figure = event.kind == FlightEvent::Kind::figure;
  const std::optional<double> figure = figure_of(record, of_figure ? event.figure : "min_clearance_m");
  if (!figure) return -std::numeric_limits<double>::infinity();
  if (of_figure) return event.below ? *figure - event.threshold : event.threshold - *figure;
  return record.result.at("outcome") == "collided" ? std::min(*figure, 0.0) : std::max(*figure, 0x1p-1022);
}

FlightEvent parse_graded_event(const std::string& text) {
  FlightEvent event = parse_event(text, "--event " + text);
  if (event.kind == FlightEvent::Kind::collision || event.kind == FlightEvent::Kind::figure) return event;
  throw InputError(fmt::format(
      "--event {}: how near a flight comes to it is not known; take collision or rate(COLUMN < NUMBER)", text));
}

std::string flight_id(const SubsetSample& s) {
  return fmt::format("flights/run{}-level{}-chain{:04}-step{}", s.run, s.level, s.chain, s.step);
}

Order order_of(const EstimatedScenario& scenario, const SubsetSample& sample) {
  Order order{.group = fmt::format("run {} level {}", sample.run, sample.level), .scenario = scenario.file};
  order.id = flight_id(sample);
  order.seed = sample.chance.seed;
  order.overrides = scenario.overrides;
  for (std::string& text : chance_override(sample.chance)) order.overrides.push_back(std::move(text));
  const LoadedScenario loaded = load_flight(scenario.file, order.overrides);
  order.inputs = loaded.inputs;
  order.scenario_yaml = resolved_yaml(loaded.scenario, order.seed);
  return order;
}

Table estimate_table(const std::vector<SubsetRun>& runs, const EstimateRecords& records) {
  std::vector<FlightRecord> rows;
  std::vector<ExtraColumn> columns;
  for (const char* name : {"run", "level", "chain", "step", "accepted", "margin"}) columns.push_back({name, {}});
  for (const SubsetSample& s : all_samples(runs)) {
    size_t column = 0;
    for (const size_t number : {s.run, s.level, s.chain, s.step, size_t{s.accepted ? 1u : 0u}}) {
      columns[column++].cells.emplace_back(static_cast<int64_t>(number));
    }
    columns[column].cells.emplace_back(s.margin);
    rows.push_back(records.at(flight_id(s)));
  }
  return flight_table(rows, columns);
}

Json estimate_json(const FlightEvent& event, const SubsetOptions& options, const std::vector<SubsetRun>& runs,
                   const EstimateRecords& records) {
  Json json{{"version", std::string(version())},
            {"build", std::string(build_identity())},
            {"event", to_string(event)},
            {"method", "subset"},
            {"samples", options.samples},
            {"seed", options.seed},
            {"flights", records.size()},
            {"probability", nullptr},
            {"runs", Json::array()}};
  for (const SubsetRun& run : runs) json["runs"].push_back(run_json(run));
  const bool all = std::ranges::all_of(runs, [](const SubsetRun& run) { return run.probability.has_value(); });
  if (all && runs.size() == 1) json["probability"] = *runs.front().probability;
  if (all && runs.size() > 1) {
    const SubsetEstimate estimate = combine(runs);
    json["probability"] = estimate.mean;
    json["interval_95"] = {estimate.low, estimate.high};
    json["cov_of_one_run"] = estimate.cov;
    // What counting would need for the same standard error.
    const double cov = estimate.cov / std::sqrt(static_cast<double>(runs.size()));
    json["plain_flights"] =
        cov > 0.0 ? Json(std::ceil((1.0 - estimate.mean) / (estimate.mean * cov * cov))) : Json(nullptr);
  }
  const auto left_none = [](const auto& entry) { return entry.second.status != FlightRecord::Status::flown; };
  json["failed"] = std::ranges::count_if(records, left_none);
  json["worst"] = worst_json(all_samples(runs), records);
  return json;
}

std::string estimate_text(const Json& json) {
  std::string text = "| run | probability | flights | levels: threshold, acceptance |\n|---|---|---|---|\n";
  size_t number = 0;
  for (const Json& run : json.at("runs")) {
    std::vector<std::string> levels;
    for (const Json& level : run.at("levels")) {
      levels.push_back(
          fmt::format("{:.3g}, {:.2f}", level.at("threshold").get<double>(), level.at("acceptance").get<double>()));
    }
    const Json& probability = run.at("probability");
    text += fmt::format(
        "| {} | {} | {} | {} |\n", number++,
        probability.is_null() ? run.at("fault").get<std::string>() : fmt::format("{:.3g}", probability.get<double>()),
        run.at("flights").get<size_t>(), fmt::join(levels, "; "));
  }
  for (const Json& flight : json.at("worst")) {
    text += fmt::format("worst  margin {:.4g}, {}\n      {}\n", flight.at("margin").get<double>(),
                        flight.at("outcome").get<std::string>(), flight.at("command").get<std::string>());
  }
  if (json.at("failed") != 0) {
    text += fmt::format("{} flights left no result and count as the event\n", json.at("failed").get<size_t>());
  }
  if (json.at("probability").is_null()) return text + "no estimate\n";
  if (!json.contains("interval_95")) return text + "one run has no interval: fly more, with --runs\n";
  const double low = json.at("interval_95").at(0), high = json.at("interval_95").at(1);
  return text + fmt::format(
                    "{}: probability {:.3g}, 95 % within {:.3g} to {:.3g}, from {} flights; a run's coefficient of "
                    "variation is {:.2f}; counting would need about {:.3g} flights\n",
                    json.at("event").get<std::string>(), json.at("probability").get<double>(), low, high,
                    json.at("flights").get<size_t>(), json.at("cov_of_one_run").get<double>(),
                    json.at("plain_flights").is_null() ? 0.0 : json.at("plain_flights").get<double>());
}

}  // namespace hedgehop::sim
