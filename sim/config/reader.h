#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/config/config_tree.h"
#include "sim/config/numbers.h"
#include "sim/fields/field.h"
#include "sim/fields/field_types.h"

/// Reads config structs from a tree through their describe(). Strict: an invalid value adds an error and leaves the
/// member unchanged.
namespace hedgehop::sim {

// Each reads one value or adds an error; `path` is dotted, from the root.
std::optional<double> read_number(const Node& node, const std::string& path, const fields::Field& field,
                                  ErrorList& errors);
std::optional<int64_t> read_signed(const Node& node, const std::string& path, const fields::Field& field,
                                   int64_t lowest, int64_t highest, ErrorList& errors);
std::optional<uint64_t> read_unsigned(const Node& node, const std::string& path, const fields::Field& field,
                                      uint64_t highest, ErrorList& errors);
std::optional<bool> read_bool(const Node& node, const std::string& path, ErrorList& errors);
std::optional<std::string> read_text(const Node& node, const std::string& path, ErrorList& errors);
/// Returns the absolute path of a file. A path in a file is relative to that file's folder, a path after --set to the
/// working folder. An empty text is an empty path.
std::optional<std::filesystem::path> read_path(const Node& node, const std::string& path, ErrorList& errors);
std::optional<size_t> read_choice(const Node& node, const std::string& path,
                                  const std::vector<std::string_view>& choices, ErrorList& errors);
/// Whether the node is a list (of `size` items unless that is 0) or a map; adds an error otherwise.
bool expect_list(const Node& node, const std::string& path, size_t size, ErrorList& errors);
bool expect_map(const Node& node, const std::string& path, ErrorList& errors);

template <class T>
void read_value(const Node& node, const std::string& path, const fields::Field& field, T& value, ErrorList& errors);

/// The visitor that reads one struct from one map.
class StructReader {
 public:
  /// @param map  a map, which must outlive the reader. @param selector  a key already read, or "".
  StructReader(const Node& map, std::string path, std::string_view selector, ErrorList& errors)
      : map_(map), path_(std::move(path)), errors_(errors) {
    if (!selector.empty()) keys_.push_back(selector);
  }

  template <class T>
  void operator()(std::string_view key, T& value, const fields::Field& field) {
    keys_.push_back(key);
    if (const Node* node = map_.find(key)) {
      read_value(*node, join_path(path_, key), field, value, errors_);
    } else if (field.required) {
      missing(key, field);
    }
  }

  /// Reports the keys that no field has.
  void finish() const;

 private:
  void missing(std::string_view key, const fields::Field& field) const;

  const Node& map_;
  std::string path_;
  ErrorList& errors_;
  std::vector<std::string_view> keys_;
};

template <fields::StructField T>
void read_struct(const Node& node, const std::string& path, std::string_view selector, T& value, ErrorList& errors) {
  if (!expect_map(node, path, errors)) return;
  StructReader reader(node, path, selector, errors);
  describe(reader, value);
  reader.finish();
}

/// Refuses a name under `selector` whose alternative is chosen by its own key.
void refuse_key_as_choice(const Node& name, std::string_view selector, ErrorList& errors);

/// Reads the alternative that one key of the map chooses by itself. @return whether there is one.
template <fields::VariantField T>
bool read_chosen_by_key(const Node& node, const std::string& path, T& value, ErrorList& errors) {
  bool chosen = false;
  fields::for_each_alternative<T>([&]<class A>() {
    if constexpr (fields::ChosenByKey<A>) {
      if (chosen || !node.find(A::kChosenBy)) return;
      chosen = true;
      A read;
      read_struct(node, path, "", read, errors);
      value = std::move(read);
    }
  });
  return chosen;
}

/// Reads the alternative that the name under `selector` chooses from the same map, starting from its defaults.
template <fields::VariantField T>
void read_variant(const Node& node, const std::string& path, const fields::Field& field, T& value, ErrorList& errors) {
  if (!expect_map(node, path, errors) || read_chosen_by_key(node, path, value, errors)) return;
  std::vector<std::string_view> names;
  fields::for_each_alternative<T>([&]<class A>() {
    if constexpr (!fields::ChosenByKey<A>) names.push_back(A::kName);
  });
  const Node* selector = node.find(field.selector);
  bool named_by_key = false;
  if (!selector) {
    if (node.incomplete) return;  // the unreadable file may have it
    errors.add(node.position, "missing key '" + std::string(field.selector) + "' in " + errors.path_text(path) +
                                  suggestion("", names));
    return;
  }
  fields::for_each_alternative<T>([&]<class A>() {
    if constexpr (fields::ChosenByKey<A>) named_by_key = named_by_key || selector->text == A::kName;
  });
  if (named_by_key) {
    refuse_key_as_choice(*selector, field.selector, errors);
    return;
  }
  const std::optional<size_t> chosen = read_choice(*selector, join_path(path, field.selector), names, errors);
  if (!chosen) return;
  size_t index = 0;
  fields::for_each_alternative<T>([&]<class A>() {
    if constexpr (!fields::ChosenByKey<A>) {
      if (index++ != *chosen) return;
      A read;
      read_struct(node, path, field.selector, read, errors);
      value = std::move(read);
    }
  });
}

template <class T>
void read_value(const Node& node, const std::string& path, const fields::Field& field, T& value, ErrorList& errors) {
  if constexpr (fields::NumberField<T>) {
    if (auto read = read_number(node, path, field, errors)) value = *read;
  } else if constexpr (std::same_as<T, bool>) {
    if (auto read = read_bool(node, path, errors)) value = *read;
  } else if constexpr (fields::IntegerField<T> && std::is_signed_v<T>) {
    using Limits = std::numeric_limits<T>;
    if (auto read = read_signed(node, path, field, Limits::min(), Limits::max(), errors)) value = static_cast<T>(*read);
  } else if constexpr (fields::IntegerField<T>) {
    const uint64_t highest = std::numeric_limits<T>::max();
    if (auto read = read_unsigned(node, path, field, highest, errors)) value = static_cast<T>(*read);
  } else if constexpr (std::same_as<T, std::string>) {
    if (auto read = read_text(node, path, errors)) value = std::move(*read);
  } else if constexpr (std::same_as<T, std::filesystem::path>) {
    if (auto read = read_path(node, path, errors)) value = std::move(*read);
  } else if constexpr (fields::ChoiceField<T>) {
    if (auto read = read_choice(node, path, field.choices, errors)) value = static_cast<T>(*read);
  } else if constexpr (fields::OptionalField<T>) {
    if (node.kind == Node::Kind::null) {
      value.reset();
    } else {
      value.emplace();
      read_value(node, path, field, *value, errors);
    }
  } else if constexpr (fields::EigenField<T>) {
    if (!expect_list(node, path, static_cast<size_t>(value.size()), errors)) return;
    for (size_t i = 0; i < node.items.size(); ++i) {
      read_value(node.items[i], join_path(path, std::to_string(i)), field, value[static_cast<Eigen::Index>(i)], errors);
    }
  } else if constexpr (fields::VectorField<T>) {
    if (!expect_list(node, path, 0, errors)) return;
    value.assign(node.items.size(), {});
    for (size_t i = 0; i < node.items.size(); ++i) {
      read_value(node.items[i], join_path(path, std::to_string(i)), field, value[i], errors);
    }
  } else if constexpr (fields::OpenField<T>) {
    if (expect_map(node, path, errors)) value = node;
  } else if constexpr (fields::VariantField<T>) {
    read_variant(node, path, field, value, errors);
  } else if constexpr (fields::SealedField<T>) {
    value.read(node, path, field, errors);
  } else {
    read_struct(node, path, "", value, errors);
  }
}

}  // namespace hedgehop::sim
