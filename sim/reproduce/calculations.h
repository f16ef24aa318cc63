#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hedgehop::sim {

/// Columns of numbers, each with a name, of equal length.
using Columns = std::map<std::string, std::vector<double>>;

/// A figure of a paper that needs no flight: a measured cost, a closed loop of a point mass.
struct Calculation {
  std::string_view name, meaning;
  std::vector<std::string> columns;  ///< of its result
  Columns (*calculate)();            ///< seconds at most
};

/// All of them, each from a file of its own.
const std::vector<Calculation>& calculations();

/// The one of that name, or none.
const Calculation* find_calculation(std::string_view name);
std::vector<std::string_view> calculation_names();

}  // namespace hedgehop::sim
