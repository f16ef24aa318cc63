#include "scenes/map/fault_lines.h"

#include <algorithm>
#include <map>
#include <string_view>

namespace hedgehop::scenes::map {

std::vector<std::string> one_line_each(const std::vector<std::string>& faults) {
  struct Object {
    std::string name;
    std::vector<std::string> faults;
  };
  std::vector<Object> objects;
  std::map<std::string, size_t> numbers;
  for (const std::string& fault : faults) {
    constexpr std::string_view kSeparator = ": ";
    const size_t end = std::min(fault.find(kSeparator), fault.size());
    const auto [place, is_new] = numbers.emplace(fault.substr(0, end), objects.size());
    if (is_new) objects.push_back({place->first, {}});
    std::vector<std::string>& own = objects[place->second].faults;
    const std::string text = fault.substr(std::min(end + kSeparator.size(), fault.size()));
    if (std::ranges::find(own, text) == own.end()) own.push_back(text);
  }
  std::vector<std::string> lines;
  for (const Object& object : objects) {
    std::string& line = lines.emplace_back(object.name);
    for (size_t k = 0; k < object.faults.size(); ++k) line += (k == 0 ? ": " : "; ") + object.faults[k];
  }
  return lines;
}

}  // namespace hedgehop::scenes::map
