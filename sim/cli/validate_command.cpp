#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "sim/batch/campaign_file.h"
#include "sim/batch/group_verdict.h"
#include "sim/batch/input_files.h"
#include "sim/batch/junit.h"
#include "sim/cli/commands.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/fly_batch.h"
#include "sim/cli/flyable.h"
#include "sim/config/include.h"
#include "sim/config/whole_file.h"
#include "sim/evidence/conduct.h"
#include "sim/falsify/falsify_file.h"
#include "sim/flight/words.h"
#include "sim/reproduce/paper.h"
#include "sim/scenario/flight_parts.h"
#include "sim/sweep/sweep_file.h"

namespace hedgehop::sim::cli {
namespace {

/// The valid content of a file, in words, the files that it reads, and remarks on the files of its scenes.
struct ValidFile {
  std::string words;
  std::set<std::filesystem::path> used;
  std::set<std::string> remarks = {};
};

enum class FileKind { plan, paper, search, sweep, flights };

/// Returns the kind that the keys of a file show. The reader of the kind reports errors of the file.
FileKind kind_of(const std::filesystem::path& file) {
  ErrorList ignored("file");
  const Node root = load_tree(file, ignored);
  const Node* const design = root.find("design");
  if (root.find("question") && root.find("flights")) return FileKind::plan;
  if (root.find("rows") && root.find("flights")) return FileKind::paper;
  if (design && design->find("budget")) return FileKind::search;
  return root.find("parameters") && root.find("scenario") ? FileKind::sweep : FileKind::flights;
}

/// Returns the content of a plan with a line for each scenario: its SHA-256, and the registered one if it differs.
ValidFile read_plan(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const Registration plan = read_registration(file);
  const std::vector<RegisteredFlights>& all = plan.config.flights;
  ValidFile valid{.words = "plan of " + counted(all.size(), "scenario"), .used = {}};
  for (const RegisteredFlights& flights : all) {
    const LoadedScenario loaded = load_flight(flights.scenario, overrides);
    const std::string found = scenario_sha256(loaded.scenario, std::filesystem::path(flights.scenario).parent_path());
    valid.words += fmt::format("\n         sha256: {}  {}", found, flights.scenario);
    if (found != flights.sha256) {
      valid.words += fmt::format(" (registered: {})", flights.sha256.empty() ? "none" : flights.sha256);
    }
  }
  return valid;
}

/// Returns the content of a scenario or a campaign. Throws InputError with every error.
ValidFile read_flights_of(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  ValidFile valid;
  const BatchOrders batch =
      read_batch({file}, {}, overrides, /*recursive=*/false,
                 [&](const Scenario&, const Order& order) { valid.remarks.merge(require_flyable(order)); });
  if (!batch.faults.empty()) throw InputError(batch.faults);
  require_decidable(batch);
  if (const auto plan = plan_of(batch)) require_planned_number(batch, *plan);
  std::map<std::string, size_t> groups;
  for (const Order& order : batch.orders) {
    if (++groups[order.group] > 1) continue;
    for (const auto& [input, hash] : order.inputs) {
      std::error_code error;
      valid.used.insert(std::filesystem::weakly_canonical(order.scenario.parent_path() / input, error));
    }
  }
  valid.words = batch.orders.size() == 1 ? fmt::format("scenario {}", batch.orders.front().group)
                                         : fmt::format("{} of {}", counted(batch.orders.size(), "flight"),
                                                       counted(groups.size(), "scenario"));
  return valid;
}

ValidFile read_valid(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  switch (kind_of(file)) {
    case FileKind::plan:
      return read_plan(file, overrides);
    case FileKind::paper:
      return {fmt::format("paper with {}", counted(read_paper(file).rows.size(), "claim")), {}};
    case FileKind::search: {
      const FalsifySearch search = read_falsify(file, overrides);
      return {fmt::format("search of {} flights of {}", search.config.design.budget, search.config.scenario), {}};
    }
    case FileKind::sweep: {
      const SweepConfig sweep = read_sweep(file, overrides);
      return {fmt::format("sweep of {} of {}", counted(sweep.parameters.size(), "parameter"), sweep.scenario), {}};
    }
    case FileKind::flights:
      return read_flights_of(file, overrides);
  }
  throw std::logic_error("unknown kind of file");
}

/// Checks files one after the other.
class Validator {
 public:
  explicit Validator(const ValidateOptions& options) : options_(options) {}

  void check_input(const std::filesystem::path& input) {
    std::error_code error;
    if (!std::filesystem::is_directory(input, error)) {
      check(input);
      return;
    }
    const FolderFiles files = files_of(input, options_.recursive);
    for (const std::string& fault : files.faults) refuse({fault});
    if (files.yaml.empty() && files.faults.empty()) {
      refuse({fmt::format("{}: no *.yaml or *.yml in this folder", input.string())});
    }
    read_each(
        files, [this](const std::filesystem::path& file) { check(file); }, [this] { return used_; });
    if (const std::string words = left_out_words(files, used_); !words.empty()) notice(words + "\n");
  }

  int conclude() const {
    fmt::print("{}: {} valid, {} invalid\n", counted(valid_ + invalid_, "file"), valid_, invalid_);
    if (!options_.junit.empty()) write_junit(options_.junit, junit_of_bad_input(faults_, junit_origin()));
    return invalid_ == 0 ? 0 : kBadInput;
  }

 private:
  void check(const std::filesystem::path& file) {
    try {
      const ValidFile found = read_valid(file, options_.overrides);
      used_.insert(found.used.begin(), found.used.end());
      fmt::print("valid    {}: {}\n", file.string(), found.words);
      for (const std::string& line : found.remarks) notice(line + "\n");
      ++valid_;
    } catch (const InputError& error) {
      fmt::print("invalid  {}\n", file.string());
      refuse(error.errors());
    }
  }

  void refuse(const std::vector<std::string>& faults) {
    ++invalid_;
    for (const std::string& fault : faults) notice(fault + "\n");
    faults_.insert(faults_.end(), faults.begin(), faults.end());
  }

  const ValidateOptions& options_;
  size_t valid_ = 0, invalid_ = 0;
  std::vector<std::string> faults_;
  std::set<std::filesystem::path> used_;
};

}  // namespace

int validate(const ValidateOptions& options) {
  if (!options.junit.empty()) require_writable_file(options.junit);
  Validator validator(options);
  for (const std::filesystem::path& input : options.inputs) validator.check_input(input);
  return validator.conclude();
}

}  // namespace hedgehop::sim::cli
