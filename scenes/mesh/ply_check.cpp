#include "scenes/mesh/ply_check.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

namespace hedgehop::scenes::mesh {
namespace {

struct Type {
  std::string_view name;
  size_t bytes;
  bool is_integer, is_signed;
};
constexpr std::array<Type, 17> kTypes{{{"char", 1, true, true},
                                       {"int8", 1, true, true},
                                       {"uchar", 1, true, false},
                                       {"uint8", 1, true, false},
                                       {"short", 2, true, true},
                                       {"int16", 2, true, true},
                                       {"ushort", 2, true, false},
                                       {"uint16", 2, true, false},
                                       {"int", 4, true, true},
                                       {"int32", 4, true, true},
                                       {"uint", 4, true, false},
                                       {"uint32", 4, true, false},
                                       {"float", 4, false, true},
                                       {"float32", 4, false, true},
                                       {"double", 8, false, true},
                                       {"double64", 8, false, true},
                                       {"float64", 8, false, true}}};

struct Property {
  std::string name;
  const Type* count = nullptr;  ///< of a list; null: one value
  const Type* value = nullptr;
};

struct Element {
  std::string name;
  double instances = 0.0;
  std::vector<Property> properties;
};

struct Header {
  std::string format;
  std::vector<Element> elements;
};

const Type* type_of(const std::string& name) {
  const auto found = std::ranges::find(kTypes, name, &Type::name);
  return found == kTypes.end() ? nullptr : &*found;
}

std::string_view take_line(std::string_view& rest) {
  const size_t end = std::min(rest.find('\n'), rest.size());
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// Reads `TYPE NAME` or `list TYPE TYPE NAME`. Returns nullopt if a type is unknown.
std::optional<Property> property_of(std::istringstream& words) {
  Property property;
  std::string type;
  words >> type;
  if (type == "list") {
    words >> type;
    property.count = type_of(type);
    if (!property.count || !property.count->is_integer) return std::nullopt;
    words >> type;
  }
  property.value = type_of(type);
  words >> property.name;
  if (!property.value || property.name.empty()) return std::nullopt;
  return property;
}

/// Takes the header from the text. Returns nullopt if a line is unknown, or without `end_header`.
std::optional<Header> take_header(std::string_view& rest) {
  Header header;
  while (!rest.empty()) {
    const std::string line{take_line(rest)};
    if (std::ranges::any_of(line, [](unsigned char c) { return c < ' ' && c != '\t'; })) return std::nullopt;
    std::istringstream words{line};
    std::string word;
    words >> word;
    if (word == "end_header") return header;
    if (word == "format") {
      words >> header.format;
    } else if (word == "element") {
      Element& element = header.elements.emplace_back();
      if (!(words >> element.name >> element.instances) || !(element.instances >= 0.0)) return std::nullopt;
    } else if (word == "property") {
      const std::optional<Property> property = property_of(words);
      if (!property || header.elements.empty()) return std::nullopt;
      header.elements.back().properties.push_back(*property);
    } else if (word != "ply" && word != "comment" && word != "obj_info") {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

/// The lists of the elements, in binary or as text. A file that ends early has no fault here.
class Lists {
 public:
  Lists(const Header& header, std::string_view data) : header_(header), data_(data) {}

  std::string fault() {
    for (const Element& element : header_.elements) {
      for (double i = 0; i < element.instances && !data_.empty(); ++i) {
        skip(element);
        if (too_long_) return "its element '" + element.name + "' has a list of more values than the file has bytes";
      }
    }
    return "";
  }

 private:
  void skip(const Element& element) {
    const bool is_text = header_.format == "ascii";
    if (is_text) take_filled_line();  // the importer expects each instance on a line of its own
    for (const Property& property : element.properties) is_text ? skip_words(property) : skip_bytes(property);
  }

  /// @param count  a negative one becomes a huge one in the importer.
  void check(double count, size_t bytes) { too_long_ = too_long_ || count < 0.0 || count > static_cast<double>(bytes); }

  void take_filled_line() {
    do {
      line_ = take_line(data_);
    } while (line_.empty() && !data_.empty());
  }

  std::string_view take_word() {
    const size_t begin = std::min(line_.find_first_not_of(" \t"), line_.size());
    const size_t end = std::min(line_.find_first_of(" \t", begin), line_.size());
    const std::string_view word = line_.substr(begin, end - begin);
    line_.remove_prefix(end);
    return word;
  }

  void skip_words(const Property& property) {
    const std::string_view word = take_word();
    if (!property.count) return;
    double count = 0.0;
    std::from_chars(word.data(), word.data() + word.size(), count);
    check(count, line_.size());
    for (double i = 0; i < count && !line_.empty(); ++i) take_word();
  }

  void skip_bytes(const Property& property) {
    double count = 1.0;
    if (property.count) {
      if (data_.size() < property.count->bytes) return data_.remove_prefix(data_.size());
      count = number(*property.count);
      data_.remove_prefix(property.count->bytes);
      check(count, data_.size());
    }
    const double bytes = count * static_cast<double>(property.value->bytes);
    data_.remove_prefix(bytes < static_cast<double>(data_.size()) ? static_cast<size_t>(bytes) : data_.size());
  }

  double number(const Type& type) const {
    const bool is_little = header_.format == "binary_little_endian";
    uint64_t bits = 0;
    for (size_t i = 0; i < type.bytes; ++i) {
      bits |= uint64_t{static_cast<unsigned char>(data_[is_little ? i : type.bytes - 1 - i])} << (8 * i);
    }
    const uint64_t sign = uint64_t{1} << (8 * type.bytes - 1);
    return type.is_signed && (bits & sign) ? -1.0 : static_cast<double>(bits);
  }

  const Header& header_;
  std::string_view data_, line_;
  bool too_long_ = false;
};

}  // namespace

std::string fault_of_ply(std::string_view ply) {
  std::string_view rest = ply;
  const std::optional<Header> header = take_header(rest);
  if (!header) return "its header is not that of a PLY";
  std::set<std::string> names;
  for (const Element& element : header->elements) {
    if (element.name == "tristrips") return "it has triangle strips; valid: faces";
    if (!names.insert(element.name).second) return "it has the element '" + element.name + "' twice";
  }
  double elements = 0.0;
  for (const Element& element : header->elements) elements += element.instances;
  if (elements > static_cast<double>(ply.size())) return "it has fewer bytes than elements";
  return Lists(*header, rest).fault();
}

}  // namespace hedgehop::scenes::mesh
