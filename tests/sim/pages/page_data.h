#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hedgehop::sim {

/// Returns the JSON data of a page.
inline nlohmann::json data_of(const std::string& page) {
  const std::string open = "id=\"data\">";
  const size_t begin = page.find(open) + open.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

}  // namespace hedgehop::sim
