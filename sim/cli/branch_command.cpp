#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "sim/batch/flight_table.h"
#include "sim/batch/fly_orders.h"
#include "sim/batch/folders.h"
#include "sim/batch/input_files.h"
#include "sim/batch/usable_cores.h"
#include "sim/cli/commands.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/fly_batch.h"
#include "sim/cli/progress.h"
#include "sim/config/config_outline.h"
#include "sim/config/folder_lock.h"
#include "sim/config/outline_texts.h"
#include "sim/config/whole_file.h"
#include "sim/evidence/batch_record.h"
#include "sim/falsify/shrink.h"
#include "sim/flight/build.h"
#include "sim/libm/random.h"
#include "sim/record/run_record.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUnbroken = "unbroken";

/// Requires that the changed settings have no effect before the time of the branch.
void require_same_before(const Scenario& base, const Scenario& changed, double at_s) {
  Scenario rest = changed;
  rest.avoidance = base.avoidance;
  rest.failures = base.failures;
  rest.checks = base.checks;
  rest.may_collide = base.may_collide;
  rest.duration_s = base.duration_s;
  if (to_yaml(rest) != to_yaml(base)) {
    throw InputError(
        "--set: in flight may change: avoidance, failures that begin later, duration, checks, may_collide");
  }
  const auto missing_in = [at_s](const std::vector<FailureConfig>& known, const std::vector<FailureConfig>& from) {
    const auto text = [](const FailureConfig& failure) { return yaml_text(outline_fields(failure)); };
    for (const FailureConfig& failure : from) {
      const bool is_known = std::ranges::any_of(known, [&](const auto& other) { return text(other) == text(failure); });
      if (is_known || failure.at_s >= at_s) continue;
      throw InputError(fmt::format("--set: the failure '{}' begins before {:g} s", to_text(failure), at_s));
    }
  };
  missing_in(base.failures, changed.failures);
  missing_in(changed.failures, base.failures);
}

/// The scenario in which other settings hold from a moment on.
Scenario branched(const Scenario& base, const BranchOptions& options, const fs::path& file) {
  const Scenario changed = load_flight(file, options.overrides).scenario;
  if (base.takeover) throw InputError(fmt::format("{}: has a 'takeover' already", file.string()));
  if (options.at_s >= base.duration_s) {
    throw InputError(fmt::format("--at {:g}: is not before the flight's end ({:g} s)", options.at_s, base.duration_s));
  }
  require_same_before(base, changed, options.at_s);
  Scenario branch = changed;
  branch.avoidance = base.avoidance;
  branch.takeover = TakeoverConfig{.at_s = options.at_s, .avoidance = changed.avoidance};
  return branch;
}

/// A name for the branch's files: "at-32.5-avoidance.speed=1". A name that is cut ends in a number of its whole text.
std::string name_of(const BranchOptions& options) {
  constexpr size_t kMaxLetters = 120, kNumberLetters = 17;
  std::string name = fmt::format("at-{:g}", options.at_s);
  for (const std::string& text : options.overrides) name += "-" + text;
  const std::string number = fmt::format("-{:016x}", stream_seed(0, name));
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && std::string_view("-_.=").find(c) == std::string_view::npos)
      c = '_';
  }
  return name.size() <= kMaxLetters ? name : name.substr(0, kMaxLetters - kNumberLetters) + number;
}

/// The scenarios of the folder, this branch's among them; a folder holds the branches of one flight.
std::vector<Order> write_scenarios(const Scenario& base, const Scenario& branch, const std::string& name,
                                   const fs::path& out) {
  const fs::path folder = out / "scenarios", unbroken = folder / (std::string(kUnbroken) + ".yaml");
  if (has_file(folder, unbroken.filename().string()) && read_file_whole(unbroken) != to_yaml(base)) {
    throw InputError(fmt::format("{}: holds branches of another flight; choose another --out", out.string()));
  }
  create_folders(folder);
  write_file_whole(unbroken, to_yaml(base));
  write_file_whole(folder / (name + ".yaml"), to_yaml(branch));
  const FolderFiles found = files_of(folder, /*recursive=*/false);
  if (!found.faults.empty()) throw InputError(found.faults);
  std::vector<fs::path> files = {unbroken};
  std::ranges::copy_if(found.yaml, std::back_inserter(files), [&](const fs::path& file) { return file != unbroken; });
  std::vector<Order> orders;
  for (const fs::path& file : files) {
    Order& order = orders.emplace_back(file_order(file, "flights/" + file.stem().string()));
    order.scenario_yaml = to_yaml(load_scenario(file));  // with its film
  }
  return orders;
}

/// The rows of a trajectory before a moment.
std::string rows_before(const fs::path& flight, double t_s) {
  std::istringstream lines(read_file_whole(flight / "trajectory.csv"));
  std::string line, rows;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    double row_s = 0.0;
    std::from_chars(line.data(), line.data() + line.size(), row_s);
    if (row_s >= t_s) break;
    rows += line + "\n";
  }
  return rows;
}

void require_equal_before(const FlightRecord& unbroken, const FlightRecord& branch, const fs::path& out, double at_s) {
  if (!unbroken.result || !branch.result) return;
  const double end_s = unbroken.result->flight.flight_time_s;
  if (end_s < at_s) throw InputError(fmt::format("--at {:g}: the flight has ended at {:g} s", at_s, end_s));
  if (rows_before(out / unbroken.order.id, at_s) != rows_before(out / branch.order.id, at_s)) {
    throw std::runtime_error(fmt::format("{}: differs from the unbroken flight before {:g} s", branch.order.id, at_s));
  }
  fmt::print("equal up to {:g} s, bit for bit: {} and {}\n", at_s, unbroken.order.id, branch.order.id);
}

int conclude(const BatchOutcome& branches, const fs::path& out) {
  write_file_whole(out / "batch.json", batch_json(branches, std::string(version())));
  write_file_whole(out / "batch.csv", flight_table(branches.records).csv());
  fmt::print("{}", summary_text(branches));
  write_campaign_page(out);
  return std::ranges::all_of(branches.records, [](const FlightRecord& r) { return holds(verdict_of(r)); }) ? 0 : kFails;
}

}  // namespace

int branch(const BranchOptions& options) {
  const bool is_run = fs::is_directory(options.source);
  const fs::path file = is_run ? options.source / "scenario.yaml" : options.source;
  if (is_run) {
    const double end_s = read_result(options.source / "result.json").flight.flight_time_s;
    if (end_s < options.at_s)
      throw InputError(fmt::format("--at {:g}: the flight has ended at {:g} s", options.at_s, end_s));
  }
  const Scenario base = load_scenario(file);
  const Scenario scenario = branched(base, options, file);
  const std::string name = name_of(options);
  const fs::path out = options.out.empty() ? fs::path("out") / (base.name + "-branches") : options.out;
  require_writable(out);
  const FolderLock lock(out);
  const std::vector<Order> orders = write_scenarios(base, scenario, name, out);

  Interruption interruption;
  CampaignProgress progress(orders.size());
  const FlyOptions fly{.program = own_program(), .out = out, .workers = usable_cores(), .reports = true};
  const auto records = fly_shown(orders, fly, interruption, progress);
  progress.close();
  if (interruption.signal() != 0) return kSignalled + interruption.signal();
  const auto flown = std::ranges::find(records, "flights/" + name, [](const FlightRecord& r) { return r.order.id; });
  require_equal_before(records.front(), *flown, out, options.at_s);
  const Conduct conduct{.planned = std::ssize(records), .seeds = std::to_string(base.seed)};
  return conclude({.records = records, .conduct = conduct}, out);
}

}  // namespace hedgehop::sim::cli
