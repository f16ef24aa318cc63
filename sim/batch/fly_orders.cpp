#include "sim/batch/fly_orders.h"

#include <fmt/format.h>
#include <unistd.h>

#include "sim/batch/worker_pool.h"
#include "sim/record/result_files.h"

namespace hedgehop::sim {
namespace {

using Status = FlightRecord::Status;

std::vector<std::string> worker_command(const Order& order, const FlyOptions& options) {
  std::vector<std::string> command{options.program.string()};
  for (std::string& argument : run_arguments(order)) command.push_back(std::move(argument));
  const std::string folder = (options.out / order.id).string(), campaign = std::to_string(::getpid());
  command.insert(command.end(), {"--out", folder, "--worker-of", campaign});
  if (!options.reports) command.insert(command.end(), {"--no-video", "--no-report"});
  return command;
}

/// What a former flight left of an order; missing when it left nothing.
FlightRecord recall(const Order& order, const std::filesystem::path& folder, bool other_builds) {
  FlightRecord record{.order = order};
  if (auto result = result_left_by(order, folder, other_builds)) {
    record.status = Status::flown;
    record.result = std::move(*result);
  }
  return record;
}

void conclude(FlightRecord& record, const WorkerEnd& end, const FlyOptions& options) {
  const bool has_verdict = end.kind == WorkerEnd::Kind::exited && (end.code == 0 || end.code == 1);
  if (has_verdict) {
    if (FlightRecord left = recall(record.order, options.out / record.order.id, options.other_builds);
        left.status == Status::flown) {
      record = std::move(left);
      return;
    }
  }
  if (end.kind == WorkerEnd::Kind::stopped) return;  // still missing
  record.status = Status::failed;
  record.cause = cause_words(end, options.limit_s);
  if (has_verdict) record.cause += "; left no result of this scenario";
}

}  // namespace

std::vector<FlightRecord> fly_orders(const std::vector<Order>& orders, const FlyOptions& options, Reuse reuse,
                                     Interruption& interruption, const OnRecord& on_record) {
  std::vector<FlightRecord> records;
  std::vector<size_t> to_fly;
  for (const Order& order : orders) {
    FlightRecord& record = records.emplace_back(FlightRecord{.order = order});
    if (options.wanted && !options.wanted(order)) continue;
    if (!order.fault.empty()) {
      record.status = Status::failed;
      record.cause = order.fault;
      on_record(record, false);
      continue;
    }
    if (reuse != Reuse::none) {
      FlightRecord former = recall(order, options.out / order.id, options.other_builds);
      if (former.status == Status::flown && (reuse == Reuse::all || passed(former))) {
        record = std::move(former);
        on_record(record, true);
        continue;
      }
    }
    to_fly.push_back(records.size() - 1);
  }

  WorkerPool pool{.workers = options.workers, .limit_s = options.limit_s};
  if (options.wanted) pool.wanted = [&](size_t job) { return options.wanted(records[to_fly[job]].order); };
  const auto command = [&](size_t job) {
    const Order& order = records[to_fly[job]].order;
    forget_flight(options.out / order.id);  // a worker that dies must not leave an earlier verdict behind
    return worker_command(order, options);
  };
  pool.run(to_fly.size(), command, interruption, [&](size_t job, const WorkerEnd& end) {
    FlightRecord& record = records[to_fly[job]];
    conclude(record, end, options);
    if (record.status != Status::missing) on_record(record, false);
  });
  return records;
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
