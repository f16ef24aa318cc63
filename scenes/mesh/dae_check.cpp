#include "scenes/mesh/dae_check.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <iterator>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>

#include "scenes/mesh/mesh_reader.h"

namespace hedgehop::scenes::mesh {

namespace {

/// Returns the depth of nested elements, counting every tag.
int xml_nesting(std::string_view xml) {
  int now = 0, deepest = 0;
  for (size_t i = xml.find('<'); i != std::string_view::npos; i = xml.find('<', i + 1)) {
    const char next = i + 1 < xml.size() ? xml[i + 1] : '>';
    if (next == '?' || next == '!') continue;
    const size_t end = xml.find('>', i);
    if (next == '/') {
      --now;
    } else if (end == std::string_view::npos || xml[end - 1] != '/') {
      deepest = std::max(deepest, ++now);
    }
  }
  return deepest;
}

/// Returns whether a list of indices has another character than digits, signs and spaces. The importer would not end.
bool has_bad_indices(std::string_view dae) {
  for (const std::string_view element : {"p", "v", "vcount"}) {
    const std::string opening = "<" + std::string(element);
    for (size_t at = dae.find(opening); at != std::string_view::npos; at = dae.find(opening, at + 1)) {
      const size_t after = at + opening.size();
      if (after >= dae.size() || (dae[after] != '>' && !std::isspace(static_cast<unsigned char>(dae[after])))) continue;
      const size_t first = dae.find('>', after);
      if (first == std::string_view::npos || dae[first - 1] == '/') continue;
      const size_t last = std::min(dae.find('<', first), dae.size());
      const std::string_view indices = dae.substr(first + 1, last - first - 1);
      if (indices.find_first_not_of("0123456789+- \t\r\n") != std::string_view::npos) return true;
    }
  }
  return false;
}

/// Returns the target of a reference in the file, such as "#numbers".
std::string_view target_of(const pugi::xml_node& node) {
  const std::string_view reference = node.attribute("source").value();
  return reference.substr(std::min<size_t>(reference.size(), 1));
}

/// Returns the number of elements in an array up to the last one that an accessor reads.
uint64_t read_by(const pugi::xml_node& accessor) {
  const uint64_t count = accessor.attribute("count").as_uint();
  const auto params = accessor.children("param");
  const auto per_item = static_cast<uint64_t>(std::distance(params.begin(), params.end()));
  if (count == 0) return 0;
  return accessor.attribute("offset").as_uint() + (count - 1) * accessor.attribute("stride").as_uint(1) + per_item;
}

/// Returns whether each array announces as many elements as its accessor reads, and whether polygons use numbers. The
/// importer would read past the array's end.
bool has_all_numbers(const std::string& dae) {
  pugi::xml_document document;
  if (!document.load_string(dae.c_str(), pugi::parse_full)) return true;  // the importer states the error
  std::map<std::string_view, uint64_t> sizes;
  std::set<std::string_view> lists_of_names;
  for (const pugi::xpath_node& found : document.select_nodes("//float_array | //Name_array | //IDREF_array")) {
    const pugi::xml_node array = found.node();
    const std::string_view id = array.attribute("id").value();
    const uint64_t size = array.attribute("count").as_uint();
    const auto [known, is_new] = sizes.emplace(id, size);
    if (!is_new) known->second = std::min(known->second, size);
    if (std::string_view(array.name()) != "float_array") lists_of_names.insert(id);
  }
  std::set<std::string_view> used_by_polygons;
  for (const pugi::xpath_node& found : document.select_nodes("//mesh//input")) {
    used_by_polygons.insert(target_of(found.node()));
  }
  for (const pugi::xpath_node& found : document.select_nodes("//accessor")) {
    const pugi::xml_node accessor = found.node();
    const auto size = sizes.find(target_of(accessor));
    if (size == sizes.end()) continue;  // the importer refuses it
    const std::string_view source = accessor.parent().parent().attribute("id").value();
    if (read_by(accessor) > size->second) return false;
    if (lists_of_names.contains(size->first) && used_by_polygons.contains(source)) return false;
  }
  return true;
}

}  // namespace

std::string fault_of_dae(const std::string& dae) {
  if (xml_nesting(dae) > kMaxNesting) return "its XML is nested deeper than " + std::to_string(kMaxNesting);
  if (has_bad_indices(dae)) return "its indices (<p>, <v> or <vcount>) are not whole numbers";
  if (!has_all_numbers(dae)) return "an <accessor> reads more numbers than the 'count' of its <float_array>";
  return {};
}

}  // namespace hedgehop::scenes::mesh
