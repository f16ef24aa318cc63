#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/falsify/shrink.h"

namespace hedgehop::sim {

/// A failure of a search, flown again, shrunk and kept.
struct Counterexample {
  size_t trial = 0;      ///< of the search
  bool repeats = false;  ///< flown again in a process of its own it was the same flight, bit for bit
  Shrunk shrunk;
  WeakestCheck weakest;        ///< of the shrunk flight
  std::filesystem::path file;  ///< its scenario, with `origin`
  std::string folder;          ///< of its flight, with film and report, relative to the search's
  bool confirmed = false;      ///< the file's flight, in a process of its own, was the shrunk one, bit for bit
};

/// Where flights of counterexamples are flown, relative to the search's folder.
struct CounterexampleFlights {
  FlyOne plain;
  FlyOne with_report;  ///< leaves film and report
};

/// Flies a failure again, shrinks it and writes counterexamples/<name>.yaml. Nothing when it was interrupted.
/// @param search_file  as the user named it, for the origin. @param out  the search's folder. @param number  from 1.
std::optional<Counterexample> keep_counterexample(const FalsifySearch& search, const std::string& search_file,
                                                  const FalsifyResult& result, size_t number,
                                                  const std::filesystem::path& out, const CounterexampleFlights& fly);

/// Text of falsify.json: the search, its flights, failures and counterexamples.
std::string falsify_json(const FalsifySearch& search, const FalsifyResult& result,
                         const std::vector<Counterexample>& counterexamples);

}  // namespace hedgehop::sim
