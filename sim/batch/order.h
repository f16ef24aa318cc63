#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

/// Many flights: batches and sweeps, each flight in a process of its own.
namespace hedgehop::sim {

/// One flight to be flown, as `hedgehop run` would fly it.
struct Order {
  std::string id;                  ///< unique in its campaign; the flight's folder, relative to the campaign's
  std::string group;               ///< name of the flights that differ by the seed alone
  std::filesystem::path scenario;  ///< file, as the user named it
  uint64_t seed = 0;
  std::vector<std::string> overrides;         ///< "a.b=value", in order
  std::string scenario_yaml;                  ///< the resolved scenario
  std::map<std::string, std::string> inputs;  ///< files that the flight depends on, with their SHA-256
  std::string fault;                          ///< why it cannot be flown at all, one line; else empty
};

/// The flight's scenario in full, as a worker writes it: with the seed, without film. Throws InputError.
std::string resolved_yaml(Scenario scenario, uint64_t seed);

/// Arguments of `hedgehop` that re-simulate an order: "run", the file, the seed, each override.
std::vector<std::string> run_arguments(const Order& order);

/// "hedgehop run FILE --seed 3 --set 'a.b=1'", ready for a POSIX shell.
std::string rerun_command(const Order& order);

/// A word quoted for a POSIX shell where it must be.
std::string shell_quoted(const std::string& word);

/// Seeds of a text like "1:10" (both ends), "3" or "1:3,7". @throws InputError for anything else, for a range that
/// falls, for a doubled seed or more than a million of them.
std::vector<uint64_t> parse_seeds(const std::string& text);

/// Seeds as parse_seeds() reads them, in rising order, each once; "" of none.
std::string seed_words(std::vector<uint64_t> seeds);

}  // namespace hedgehop::sim
