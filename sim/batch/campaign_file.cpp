#include "sim/batch/campaign_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "sim/batch/input_files.h"
#include "sim/batch/seeds.h"
#include "sim/config/include.h"
#include "sim/config/input_error.h"
#include "sim/config/reader.h"
#include "sim/config/utf8.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRefused = "/bad";  // end of the id of a file that cannot be flown; others end with their seed

template <class Named>
std::set<std::string> names_of(const std::vector<Named>& all, std::vector<std::string>& faults) {
  std::set<std::string> names;
  for (const Named& one : all) {
    if (!names.insert(one.name).second) faults.push_back(fmt::format("leaderboard: '{}' occurs twice", one.name));
  }
  return names;
}

/// Letters that are safe in a folder's name everywhere, and all letters beyond ASCII.
/// @param number  of the group among those whose names give the same folder, from 1.
std::string folder_name(const std::string& group, int number) {
  constexpr size_t kMaxNameLength = 120;
  std::string name;
  for (std::string_view rest = group; !rest.empty();) {
    const size_t length = std::max<size_t>(1, first_character(rest).first);
    const char c = rest[0];
    const bool safe =
        length > 1 || std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.' || c == '=' || c == '_';
    const std::string_view next = safe ? rest.substr(0, length) : "_";
    if (name.size() + next.size() > kMaxNameLength) break;
    name += next;
    rest.remove_prefix(length);
  }
  if (name.empty() || name[0] == '.') name = "_" + name;
  return number == 1 ? name : fmt::format("{}~{}", name, number);
}

void examine_seeds(const CampaignConfig& campaign, const Node& root, ErrorList& faults) {
  const auto examine = [&](const std::string& at, const std::optional<std::string>& tuned_on,
                           const std::string& seeds) {
    if (std::string fault = judging_fault(tuned_on, seeds); !fault.empty())
      faults.add(position_of(root, at + ".seeds"), std::move(fault));
  };
  for (size_t i = 0; i < campaign.flights.size(); ++i) {
    const CampaignFlights& flights = campaign.flights[i];
    examine(fmt::format("flights.{}", i), flights.tuned_on ? flights.tuned_on : campaign.tuned_on, flights.seeds);
  }
  if (campaign.leaderboard) examine("leaderboard", campaign.tuned_on, campaign.leaderboard->seeds);
}

/// Gathers orders and keeps their groups and folders apart.
class Gatherer {
 public:
  Gatherer(const std::vector<uint64_t>& seeds, const std::vector<std::string>& overrides, const OrderCheck& check)
      : seeds_(seeds), overrides_(overrides), check_(check) {}

  void add_input(const fs::path& input, bool recursive) {
    std::error_code error;
    if (!fs::is_directory(input, error)) {
      add_file(input);
      return;
    }
    const FolderFiles files = files_of(input, recursive);
    batch_.faults.insert(batch_.faults.end(), files.faults.begin(), files.faults.end());
    if (files.yaml.empty() && files.faults.empty())
      batch_.faults.push_back(fmt::format("{}: no *.yaml or *.yml in this folder", input.string()));
    read_each(
        files, [this](const fs::path& file) { add_file(file); }, [this] { return used_files(); });
    if (std::string words = left_out_words(files, used_files()); !words.empty())
      batch_.left_out.push_back(std::move(words));
  }

  /// @param name  of the group; empty: the scenario's name and its overrides. @return the group's name.
  std::string add_scenario(const fs::path& file, const std::vector<uint64_t>& seeds, std::vector<std::string> overrides,
                           const std::string& name) {
    overrides.insert(overrides.end(), overrides_.begin(), overrides_.end());
    Order order{.group = name, .scenario = file.lexically_normal(), .overrides = overrides};
    try {
      const Scenario scenario = load_order(file, order);
      if (name.empty()) {
        order.group = scenario.name;
        for (const std::string& text : overrides) order.group += " " + text;
      }
      order.seed = seeds.empty() ? scenario.seed : seeds.front();
      if (check_) check_(scenario, order);
      const std::string folder = claim(order);
      for (const uint64_t seed : seeds.empty() ? std::vector<uint64_t>{scenario.seed} : seeds) {
        order.id = fmt::format("{}/seed{}", folder, seed);
        order.seed = seed;
        order.scenario_yaml = resolved_yaml(scenario, seed);
        add_order(order, ids_, batch_);
      }
    } catch (const InputError& error) {
      if (name.empty()) order.group = name_text(file.stem().string());
      add_refused(order, error);
    }
    return order.group;
  }

  /// @param folder  that the scenarios' paths are relative to.
  void add_flights(const std::vector<CampaignFlights>& all, const fs::path& folder) {
    for (const CampaignFlights& flights : all) {
      add_scenario(folder / flights.scenario, seeds_.empty() ? parse_seeds(flights.seeds) : seeds_,
                   with_module_paths(flights.set, folder), "");
    }
  }

  BatchOrders take() { return std::move(batch_); }

 private:
  void add_file(const fs::path& file) {
    ErrorList faults("campaign");
    const Node root = load_tree(file, faults);
    if (faults.empty() && (root.find("flights") || root.find("leaderboard"))) {
      add_campaign(file, root);
    } else {
      add_scenario(file, seeds_, {}, "");
    }
  }

  void add_campaign(const fs::path& file, const Node& root) {
    try {
      ErrorList faults("campaign");
      CampaignConfig campaign;
      read_struct(root, "", "", campaign, faults);
      faults.throw_if_any();
      examine_seeds(campaign, root, faults);
      faults.throw_if_any();
      positions_ = override_positions(root, file.parent_path());
      add_flights(campaign.flights, file.parent_path());
      if (campaign.leaderboard) add_leaderboard(file.parent_path(), *campaign.leaderboard);
      if (campaign.plan) batch_.plan = (file.parent_path() / *campaign.plan).lexically_normal();
      if (!campaign.description.empty())
        batch_.description += (batch_.description.empty() ? "" : "; ") + campaign.description;
      if (campaign.tuned_on) batch_.tuned_on += (batch_.tuned_on.empty() ? "" : ", ") + *campaign.tuned_on;
      for (CampaignCheck& check : campaign.checks) {
        if (auto* no_worse = std::get_if<NoWorseCheck>(&check))
          no_worse->than = (file.parent_path() / no_worse->than).lexically_normal().string();
        batch_.checks.push_back(check);
      }
    } catch (const InputError& error) {
      Order order{.group = name_text(file.stem().string()), .scenario = file};
      add_refused(order, error);
    }
  }

  void add_leaderboard(const fs::path& folder, const LeaderboardConfig& config) {
    const std::vector<uint64_t> seeds = seeds_.empty() ? parse_seeds(config.seeds) : seeds_;
    Leaderboard board = leaderboard_of(config);
    auto cell = board.cells.begin();
    for (const LeaderboardWorld& world : config.worlds) {
      for (const LeaderboardModule& module : config.modules) {
        if (cell->reason.empty()) {
          cell->group = add_scenario(folder / world.scenario, seeds, with_module_paths(module.set, folder),
                                     world.name + " " + module.name);
        }
        ++cell;
      }
    }
    batch_.leaderboard = std::move(board);
  }

  /// Returns a folder for a scenario with its overrides. The group gets a distinct name if another file has the same
  /// name.
  std::string claim(Order& order) {
    const std::string key = order.scenario.string() + "\n" + fmt::format("{}", fmt::join(order.overrides, "\n"));
    if (const auto known = folders_.find(key); known != folders_.end()) {
      order.group = known->second.first;
      return known->second.second;
    }
    int number = 1;
    while (taken_.contains(folder_name(order.group, number))) ++number;
    const std::string folder = folder_name(order.group, number);
    if (number > 1) order.group += fmt::format("~{}", number);
    taken_.insert({folder, 0});
    folders_[key] = {order.group, folder};
    return folder;
  }

  /// Returns the files that the orders read, canonical.
  std::set<fs::path> used_files() const {
    std::set<fs::path> used;
    std::error_code error;
    for (const Order& order : batch_.orders) {
      for (const auto& [file, hash] : order.inputs) {
        used.insert(fs::weakly_canonical(order.scenario.parent_path() / file, error));
      }
    }
    return used;
  }

  void add_refused(Order& order, const InputError& error) {
    order.id = claim(order) + kRefused;
    refuse(order, at_overrides(error.errors(), order.overrides, positions_));
    add_order(order, ids_, batch_);
  }

  const std::vector<uint64_t>& seeds_;
  const std::vector<std::string>& overrides_;
  const OrderCheck& check_;
  BatchOrders batch_;
  OverridePositions positions_;                                         ///< of the last campaign
  std::map<std::string, std::pair<std::string, std::string>> folders_;  ///< file and overrides: group and folder
  std::map<std::string, int> taken_;
  std::set<std::string> ids_;
};

}  // namespace

Leaderboard leaderboard_of(const LeaderboardConfig& config) {
  std::vector<std::string> faults;
  const std::set<std::string> worlds = names_of(config.worlds, faults), modules = names_of(config.modules, faults);
  Leaderboard board{.worlds = config.worlds, .modules = config.modules, .cells = {}};
  for (const LeaderboardWorld& world : config.worlds) {
    for (const LeaderboardModule& module : config.modules) board.cells.push_back({world.name, module.name, "", ""});
  }
  for (const LeaderboardGap& gap : config.not_flown) {
    if (!modules.contains(gap.module)) faults.push_back(fmt::format("leaderboard: no module '{}'", gap.module));
    if (gap.reason.empty())
      faults.push_back(fmt::format("leaderboard: '{}' is not flown without a reason", gap.module));
    for (const std::string& world : gap.worlds) {
      if (!worlds.contains(world)) faults.push_back(fmt::format("leaderboard: no world '{}'", world));
      for (LeaderboardCell& cell : board.cells) {
        if (cell.world == world && cell.module == gap.module) cell.reason = gap.reason;
      }
    }
  }
  if (!faults.empty()) throw InputError(faults);
  return board;
}

Scenario load_order(const fs::path& file, Order& order) {
  LoadedScenario loaded = load_flight(file, order.overrides);
  order.inputs = std::move(loaded.inputs);
  order.scenario_sha256 = scenario_sha256(loaded.scenario, file.parent_path());
  return std::move(loaded.scenario);
}

void refuse(Order& order, const std::vector<std::string>& faults) {
  order.fault = faults.front();
  order.more_faults.assign(faults.begin() + 1, faults.end());
}

void add_order(Order order, std::set<std::string>& ids, BatchOrders& batch) {
  std::vector<std::string> faults = order.more_faults;
  if (!order.fault.empty()) faults.insert(faults.begin(), order.fault);
  for (const std::string& fault : faults) {
    // An override that no scenario accepts is one fault, not one per scenario.
    if (std::ranges::find(batch.faults, fault) == batch.faults.end()) batch.faults.push_back(fault);
  }
  if (ids.insert(order.id).second) batch.orders.push_back(std::move(order));
}

bool is_refused(const Order& order) { return !order.fault.empty() || order.id.ends_with(kRefused); }

std::vector<FlightRecord> without_refused(std::vector<FlightRecord> records) {
  std::erase_if(records, [](const FlightRecord& record) { return is_refused(record.order); });
  return records;
}

BatchOrders read_batch(const std::vector<fs::path>& inputs, const std::vector<uint64_t>& seeds,
                       const std::vector<std::string>& overrides, bool recursive, const OrderCheck& check) {
  Gatherer gatherer(seeds, overrides, check);
  for (const fs::path& input : inputs) gatherer.add_input(input, recursive);
  return gatherer.take();
}

BatchOrders orders_of(const std::vector<CampaignFlights>& flights, const std::vector<uint64_t>& seeds,
                      const std::vector<std::string>& overrides, const OrderCheck& check) {
  Gatherer gatherer(seeds, overrides, check);
  gatherer.add_flights(flights, {});
  return gatherer.take();
}

}  // namespace hedgehop::sim
