#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/config/config_tree.h"
#include "sim/config/numbers.h"
#include "sim/fields/bounds.h"
#include "sim/fields/field.h"
#include "sim/fields/field_types.h"

/// A config struct as a tree of described values, from which YAML, schema and documentation are written.
namespace hedgehop::sim {

struct ConfigOutline {
  enum class Kind { number, integer, boolean, text, choice, any, list, group, variant };

  Kind kind = Kind::group;
  std::string key;                   ///< in its group; empty for items
  fields::Field field;               ///< unit, bounds, choices, meaning
  std::string value;                 ///< of a scalar: as YAML holds it, not quoted
  bool non_negative = false;         ///< an integer whose type has no sign
  bool optional = false;             ///< may be null
  bool present = true;               ///< an optional that holds a value
  size_t fixed_size = 0;             ///< of a list: its number of items; 0 for any number
  std::vector<ConfigOutline> parts;  ///< fields of a group or of a variant's choice; items of a list
  std::vector<ConfigOutline> item;   ///< of a list: one item, of default value
  std::string chosen;                ///< of a variant: name of the choice
  std::vector<ConfigOutline> all;    ///< of a variant: every choice as a group of default values, keyed by its name
  std::string_view meaning = {};     ///< of a variant's choice: its kMeaning
  bool open = false;                 ///< a group that may hold any keys
  bool chosen_by_key = false;        ///< a variant whose choice needs no selector, or such a choice

  /// Whether it has a value and no parts.
  bool is_scalar() const { return kind != Kind::list && kind != Kind::group && kind != Kind::variant; }
};

/// Returns the outline of an uninterpreted map: a group of texts.
ConfigOutline outline_as_written(const Node& node);

template <class T>
ConfigOutline outline(const T& value, const fields::Field& field);

/// The visitor that outlines the fields of one struct.
class StructOutliner {
 public:
  explicit StructOutliner(std::vector<ConfigOutline>& parts) : parts_(parts) {}

  template <class T>
  void operator()(std::string_view key, const T& value, const fields::Field& field) {
    parts_.push_back(outline(value, field));
    parts_.back().key = key;
  }

 private:
  std::vector<ConfigOutline>& parts_;
};

template <fields::StructField T>
std::vector<ConfigOutline> outline_fields(const T& value) {
  std::vector<ConfigOutline> parts;
  StructOutliner outliner(parts);
  describe(outliner, value);
  return parts;
}

template <fields::VariantField T>
std::vector<ConfigOutline> outline_alternatives() {
  std::vector<ConfigOutline> all;
  fields::for_each_alternative<T>([&]<class A>() {
    ConfigOutline choice;
    choice.key = A::kName;
    choice.meaning = A::kMeaning;
    choice.chosen_by_key = fields::ChosenByKey<A>;
    choice.parts = outline_fields(A{});
    all.push_back(std::move(choice));
  });
  return all;
}

/// Returns the default value of a member. Eigen leaves its own default values uninitialized.
template <class T>
T default_value() {
  if constexpr (fields::EigenField<T>) {
    return T::Zero();
  } else {
    return T{};
  }
}

template <class T>
ConfigOutline outline(const T& value, const fields::Field& field) {
  ConfigOutline node;
  if constexpr (fields::OptionalField<T>) {
    using Value = typename T::value_type;
    node = outline(value ? *value : default_value<Value>(), field);
    node.optional = true;
    node.present = value.has_value();
    return node;
  }
  if constexpr (fields::SealedField<T>) return value.outlined(field);
  if constexpr (fields::OpenField<T>) {
    node = outline_as_written(value);
    node.open = node.present = true;
  }
  node.field = fields::bounded(field);
  if constexpr (fields::NumberField<T>) {
    node.kind = ConfigOutline::Kind::number;
    node.value = number_text(value, fields::is_degrees(field.unit));
  } else if constexpr (std::same_as<T, bool>) {
    node.kind = ConfigOutline::Kind::boolean;
    node.value = value ? "true" : "false";
  } else if constexpr (fields::IntegerField<T>) {
    node.kind = ConfigOutline::Kind::integer;
    node.value = std::to_string(value);
    node.non_negative = std::is_unsigned_v<T>;
  } else if constexpr (std::same_as<T, std::string>) {
    node.kind = ConfigOutline::Kind::text;
    node.value = value;
  } else if constexpr (std::same_as<T, std::filesystem::path>) {
    node.kind = ConfigOutline::Kind::text;
    node.value = value.string();
  } else if constexpr (fields::ChoiceField<T>) {
    node.kind = ConfigOutline::Kind::choice;
    node.value = field.choices.at(static_cast<size_t>(value));
  } else if constexpr (fields::EigenField<T>) {
    node.kind = ConfigOutline::Kind::list;
    node.fixed_size = static_cast<size_t>(value.size());
    for (double component : value) node.parts.push_back(outline(component, field));
    node.item.push_back(outline(0.0, field));
  } else if constexpr (fields::VectorField<T>) {
    node.kind = ConfigOutline::Kind::list;
    for (const auto& item : value) node.parts.push_back(outline(item, field));
    node.item.push_back(outline(default_value<typename T::value_type>(), field));
  } else if constexpr (fields::VariantField<T>) {
    node.kind = ConfigOutline::Kind::variant;
    node.all = outline_alternatives<T>();
    node.chosen = node.all.at(value.index()).key;
    node.chosen_by_key = node.all.at(value.index()).chosen_by_key;
    node.parts = std::visit([](const auto& chosen) { return outline_fields(chosen); }, value);
  } else if constexpr (fields::StructField<T>) {
    node.kind = ConfigOutline::Kind::group;
    node.parts = outline_fields(value);
  }
  return node;
}

}  // namespace hedgehop::sim
