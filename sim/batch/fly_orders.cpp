#include "sim/batch/fly_orders.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

#include "sim/record/result_files.h"

namespace hedgehop::sim {
namespace {

using Status = FlightRecord::Status;

/// @param worker  number of the process, for an autopilot of its own.
std::vector<std::string> worker_command(const Order& order, const FlyOptions& options, size_t worker) {
  std::vector<std::string> command{options.program.string()};
  for (std::string& argument : run_arguments(order)) command.push_back(std::move(argument));
  const std::string folder = (options.out / order.id).string(), campaign = std::to_string(::getpid());
  command.insert(command.end(), {"--out", folder, "--worker-of", campaign});
  if (worker > 0) command.insert(command.end(), {"--link-worker", std::to_string(worker)});
  if (!options.reports) command.insert(command.end(), {"--no-video", "--no-report"});
  if (!options.keep.empty()) {
    command.insert(command.end(), {"--keep-if-failed", fmt::format("{}", fmt::join(options.keep, ","))});
  }
  return command;
}

/// Returns the record of an earlier flight of an order; its status is missing if there is no result.
FlightRecord recall(const Order& order, const std::filesystem::path& folder, bool other_builds) {
  FlightRecord record{.order = order};
  if (auto result = result_left_by(order, folder, other_builds)) {
    record.status = Status::flown;
    record.result = std::move(*result);
  }
  return record;
}

}  // namespace

std::optional<std::vector<std::string>> kept_artifacts(const std::string& text) {
  constexpr std::string_view kPrefix = "failed=";
  constexpr std::array<std::string_view, 4> kArtifacts = {"report", "film", "replay", "csv"};
  if (!text.starts_with(kPrefix)) return {};
  std::vector<std::string> kept;
  std::istringstream words(text.substr(kPrefix.size()));
  for (std::string word; std::getline(words, word, ',');) {
    if (std::ranges::find(kArtifacts, word) == kArtifacts.end()) return {};
    kept.push_back(word);
  }
  return kept.empty() ? std::nullopt : std::optional(kept);
}

OrderFlights::OrderFlights(const std::vector<Order>& orders, FlyOptions options, Reuse reuse,
                           Interruption& interruption)
    : options_(std::move(options)), reuse_(reuse), pool_(options_.workers, options_.limit_s, interruption) {
  for (const Order& order : orders) records_.push_back({.order = order});
}

std::optional<EndedFlight> OrderFlights::next_unflown() {
  while (examined_ < records_.size()) {
    const size_t index = examined_++;
    FlightRecord& record = records_[index];
    const Order& order = record.order;
    if (dropped_.contains(order.id)) continue;
    if (!order.fault.empty()) {
      record.status = Status::failed;
      record.cause = order.fault;
      return EndedFlight{record};
    }
    if (reuse_ != Reuse::none) {
      FlightRecord former = recall(order, options_.out / order.id, options_.other_builds);
      const Verdict verdict = verdict_of(former);
      if (verdict != Verdict::not_flown && (reuse_ == Reuse::all || verdict == Verdict::passed)) {
        record = std::move(former);
        return EndedFlight{record, /*reused=*/true};
      }
    }
    to_fly_.push_back(index);
  }
  return {};
}

void OrderFlights::start(size_t index) {
  const Order& order = records_[index].order;
  forget_flight(options_.out / order.id);  // a worker that dies must not leave an earlier verdict behind
  const size_t worker = free_worker();
  worker_of_[index] = worker;
  pool_.start(index, worker_command(order, options_, worker));
}

size_t OrderFlights::free_worker() const {
  size_t worker = 0;
  while (std::ranges::any_of(worker_of_, [&](const auto& running) { return running.second == worker; })) ++worker;
  return worker;
}

std::optional<EndedFlight> OrderFlights::next() {
  if (std::optional<EndedFlight> ended = next_unflown()) return ended;
  for (;;) {
    while (started_ < to_fly_.size() && pool_.has_room()) {
      const size_t index = to_fly_[started_++];
      if (!dropped_.contains(records_[index].order.id)) start(index);
    }
    const std::optional<JobEnd> end = pool_.next();
    if (!end) return {};
    worker_of_.erase(end->job);
    FlightRecord& record = records_[end->job];
    conclude(record, end->end);
    if (record.status != Status::missing) return EndedFlight{record};
  }
}

void OrderFlights::drop(const Order& order) {
  dropped_.insert(order.id);
  pool_.stop_if([&](size_t index) { return records_[index].order.id == order.id; });
}

void OrderFlights::conclude(FlightRecord& record, const WorkerEnd& end) const {
  const bool has_verdict = end.kind == WorkerEnd::Kind::exited && (end.code == 0 || end.code == 1);
  if (has_verdict) {
    FlightRecord left = recall(record.order, options_.out / record.order.id, options_.other_builds);
    if (left.status == Status::flown) {
      record = std::move(left);
      return;
    }
  }
  if (end.kind == WorkerEnd::Kind::stopped) return;  // still missing
  record.status = Status::failed;
  record.cause = cause_words(end, options_.limit_s);
  if (has_verdict) record.cause += "; left no result of this scenario";
}

std::vector<FlightRecord> gather(const std::vector<Order>& orders, const std::vector<std::filesystem::path>& folders,
                                 bool other_builds) {
  std::vector<FlightRecord> records;
  for (const Order& order : orders) {
    FlightRecord& record = records.emplace_back(FlightRecord{.order = order});
    for (const std::filesystem::path& folder : folders) {
      if (record.status == Status::missing) record = recall(order, folder / order.id, other_builds);
    }
  }
  return records;
}

}  // namespace hedgehop::sim
