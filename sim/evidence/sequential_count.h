#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "sim/batch/group_verdict.h"
#include "sim/evidence/claims.h"

namespace hedgehop::sim {

/// The result of a stopping rule for one group of flights.
struct SequentialResult {
  std::string group, claim;
  Standing standing = Standing::undecided;
  double confidence = 0.95;
  int64_t planned = 0;                ///< flights, or pairs of them
  int64_t counted = 0;                ///< of those, the ones up to the stop
  std::optional<uint64_t> last_seed;  ///< that counted; none without any
  nlohmann::ordered_json figures;     ///< counts, evidence, interval, method: of the tally
  std::string words;                  ///< the complete sentence
  double value = 0.0, bound = 0.0;    ///< value and bound of the verdict
};
nlohmann::ordered_json to_json(const SequentialResult& result);
/// Returns the result as a verdict over the seeds, which passes if the claim is shown.
GroupVerdict verdict_of(const SequentialResult& result);

/// Counts flights in the order of their orders, not of their ends: a flight counts when all flights before it have
/// ended, and the rule is evaluated after each. Flights past the stop have no effect. The result is therefore equal for
/// any number of workers and after an interruption, and flights that end early are not more likely to be counted.
/// Refused orders are neither planned nor counted nor discarded.
class SequentialCount {
 public:
  /// @param orders  in the order in which they are to be flown. A claim about pairs takes the first order of a seed as
  /// base and the second as candidate, all in one group; else each group has its own count.
  SequentialCount(StoppingRule rule, const std::vector<Order>& orders);

  /// Adds a flight that has ended; flights may end in any order. Returns whether it has decided its group. The other
  /// flights of a decided group do not count.
  bool ended(const FlightRecord& record);
  /// Whether the flight has been counted.
  bool counted(const Order& order) const;
  /// Whether the flight lies past its group's stop.
  bool discarded(const Order& order) const;

  std::vector<SequentialResult> results() const;

 private:
  struct Group {
    std::string name;
    std::variant<RateTally, PairTally> tally;
    std::vector<uint64_t> seeds;                               ///< one a unit
    std::vector<std::vector<std::optional<double>>> observed;  ///< of each unit's flights
    size_t next = 0;                                           ///< unit to be counted next
    Standing standing = Standing::undecided;
  };
  struct FlightSlot {
    size_t group, unit, member;
  };
  Group& group_named(const std::string& name);
  const FlightSlot* slot_of(const Order& order) const;  ///< nullptr for a refused order
  static void advance(Group& group);
  SequentialResult result_of(const Group& group) const;

  StoppingRule rule_;
  std::vector<Group> groups_;
  std::map<std::string, FlightSlot> slots_;  ///< by the order's id
};

/// Orders seed by seed: the first of every group, then the second of every group, and so on.
std::vector<Order> seed_by_seed(const std::vector<Order>& orders);

}  // namespace hedgehop::sim
