#include "sim/falsify/counterexample.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "sim/config/utf8.h"
#include "sim/config/whole_file.h"
#include "sim/flight/build.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

std::string hash_of(const FlightRecord& record) { return record.result ? record.result->flight.trajectory_hash : ""; }

/// Compares two flights bit for bit.
Repeat repeat_of(const FlightRecord& a, const FlightRecord& b, const std::string& check) {
  const auto of_a = weakest_check(a, {check}), of_b = weakest_check(b, {check});
  if (!of_a || !of_b) return Repeat::not_flown;
  const bool equal = hash_of(a) == hash_of(b) && of_a->name == of_b->name && of_a->robustness == of_b->robustness;
  return equal ? Repeat::equal : Repeat::differs;
}

/// Returns true, false, or null for a repeat that was not flown.
Json repeat_json(Repeat repeat) { return repeat == Repeat::not_flown ? Json(nullptr) : Json(repeat == Repeat::equal); }

/// Writes the scenario of the shrunk flight, which can serve as a regression test, and returns its file.
std::filesystem::path write_scenario(const Counterexample& found, const std::string& name,
                                     const std::string& search_file, const std::string& check,
                                     const std::filesystem::path& out) {
  Scenario scenario = found.shrunk.scenario;
  scenario.name = name;
  scenario.seed = found.shrunk.record.order.seed;
  scenario.origin = OriginConfig{.search = search_file,
                                 .failed = check,
                                 .trajectory_hash = hash_of(found.shrunk.record),
                                 .version = std::string(version()),
                                 .robustness = found.weakest.robustness};
  std::filesystem::create_directories(out / "counterexamples");
  const std::filesystem::path file = out / "counterexamples" / (name + ".yaml");
  write_file_whole(file, to_yaml(scenario));
  return file;
}

Json counterexample_json(const FalsifyResult& result, const Counterexample& found) {
  const FalsifyTrial& trial = result.trials[found.trial];
  return Json{{"name", found.file.stem().string()},
              {"flight", result.records[trial.record].order.id},
              {"seed", found.shrunk.record.order.seed},
              {"check", trial.weakest.name},
              {"outcome", outcome_words(found.shrunk.record)},
              {"robustness", trial.weakest.robustness},
              {"repeats", repeat_json(found.repeats)},
              {"file", (std::filesystem::path("counterexamples") / found.file.filename()).string()},
              {"folder", found.folder},
              {"shrunk_robustness", found.weakest.robustness},
              {"trajectory_hash", hash_of(found.shrunk.record)},
              {"confirmed", repeat_json(found.confirmed)},
              {"items", found.shrunk.items},
              {"items_before", found.shrunk.items_before},
              {"duration_s", found.shrunk.scenario.duration_s},
              {"shrinking_flights", found.shrunk.trials}};
}

}  // namespace

std::optional<Counterexample> keep_counterexample(const FalsifySearch& search, const std::string& search_file,
                                                  const FalsifyResult& result, size_t number,
                                                  const std::filesystem::path& out, const CounterexampleFlights& fly) {
  Counterexample found{.trial = result.failures[number - 1]};
  const FalsifyTrial& trial = result.trials[found.trial];
  const FlightRecord& record = result.records[trial.record];
  const std::string& check = trial.weakest.name;
  const std::string name = fmt::format("{}-{}-{}", std::filesystem::path(search_file).stem().string(), number, check);

  Order again = record.order;
  again.id = "again/" + name;
  const std::optional<FlightRecord> repeated = fly.plain(again);
  if (!repeated) return {};
  found.repeats = repeat_of(record, *repeated, check);

  found.shrunk = shrink(search, trial, record, out / "shrink" / name,
                        static_cast<size_t>(search.config.design.shrinking), [&](const Order& order) {
                          Order inside = order;
                          inside.id = "shrink/" + order.id;
                          return fly.plain(inside);
                        });
  if (found.shrunk.stopped) return {};
  found.weakest = weakest_check(found.shrunk.record, {check}).value();  // it failed, so it was flown

  found.file = write_scenario(found, name, search_file, check, out);
  found.folder = "counterexamples/" + name;
  Order kept = file_order(found.file, found.folder);
  kept.scenario_yaml = to_yaml(load_scenario(found.file));  // which records a video
  const std::optional<FlightRecord> confirmed = fly.with_report(kept);
  if (!confirmed) return {};
  found.confirmed = repeat_of(found.shrunk.record, *confirmed, check);
  return found;
}

std::string falsify_json(const FalsifySearch& search, const FalsifyResult& result,
                         const std::vector<Counterexample>& counterexamples, const CompetitionSuite* suite) {
  constexpr const char* kMethods[] = {"cma_es", "direct", "random"};
  Json json{{"version", std::string(version())},
            {"build", std::string(build_identity())},
            {"description", search.config.description},
            {"search", search.identity},
            {"method", kMethods[static_cast<size_t>(search.config.design.method)]},
            {"seed", search.config.design.seed},
            {"budget", search.config.design.budget},
            {"checks", search.config.robustness},  // empty: all
            {"unknowns", search.sweep.parameters.size()},
            {"flights", result.records.size()},
            {"flights_not_flown", std::ranges::count(result.records, Verdict::not_flown,
                                                     [](const FlightRecord& record) { return verdict_of(record); })},
            {"infeasible_points", result.infeasible},
            {"flights_to_first", nullptr},
            {"failing_flights", 0},
            {"failures", result.failures.size()},
            {"counterexamples", Json::array()},
            {"suite", suite ? suite_json(*suite) : Json()}};
  if (!result.failures.empty()) json["flights_to_first"] = 1 + result.trials[result.failures[0]].record;
  for (const FalsifyTrial& trial : result.trials) {
    if (trial.fails()) json["failing_flights"] = json["failing_flights"].get<size_t>() + 1;
  }
  for (const Counterexample& found : counterexamples) {
    json["counterexamples"].push_back(counterexample_json(result, found));
  }
  return json_text(json, 2) + "\n";
}

}  // namespace hedgehop::sim
