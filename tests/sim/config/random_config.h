#pragma once

#include <cmath>
#include <random>

#include "sim/fields/field.h"
#include "sim/fields/field_types.h"
#include "sim/scenario/avoidance_choice.h"

namespace hedgehop::sim {

/// A visitor that gives every field a random value within its bounds.
class Randomizer {
 public:
  explicit Randomizer(uint64_t seed) : random_(seed) {}

  template <class T>
  void operator()(std::string_view, T& value, const fields::Field& listed) {
    const fields::Field field = fields::bounded(listed);
    if constexpr (fields::NumberField<T>) {
      value = number(field);
    } else if constexpr (std::same_as<T, bool>) {
      value = random_() % 2 == 0;
    } else if constexpr (fields::IntegerField<T>) {
      const double low = field.at_least.value_or(field.above ? *field.above + 1.0 : 0.0);
      const double high = field.at_most.value_or(field.below ? *field.below - 1.0 : low + 1e6);
      value = static_cast<T>(low) + static_cast<T>(random_() % static_cast<uint64_t>(high - low + 1.0));
    } else if constexpr (std::same_as<T, std::string>) {
      value = text();
    } else if constexpr (std::same_as<T, std::filesystem::path>) {
      value = random_() % 2 == 0 ? "" : "/calibrations/a b.txt";
    } else if constexpr (fields::ChoiceField<T>) {
      value = static_cast<T>(random_() % field.choices.size());
    } else if constexpr (fields::OptionalField<T>) {
      value.reset();
      if (random_() % 2 == 0) (*this)("", value.emplace(), field);
    } else if constexpr (fields::EigenField<T>) {
      for (double& component : value) component = number(field);
    } else if constexpr (fields::VectorField<T>) {
      value.assign(random_() % 4, {});
      for (auto& item : value) (*this)("", item, field);
    } else if constexpr (fields::OpenField<T>) {
      value = map(2);
    } else if constexpr (fields::SealedField<T>) {
      auto choice = value.choice();
      (*this)("", choice.module, field);
      value = choice;
    } else if constexpr (fields::VariantField<T>) {
      size_t chosen = random_() % std::variant_size_v<T>;
      fields::for_each_alternative<T>([&]<class A>() {
        if (chosen-- == 0) describe(*this, value.template emplace<A>());
      });
    } else {
      describe(*this, value);
    }
  }

 private:
  /// Anything a map may hold, so many levels deep.
  Node map(int depth) {
    Node node{.kind = Node::Kind::map};
    for (size_t i = random_() % 4; i > 0; --i) node.entries.push_back({"key" + std::to_string(i), {}, any(depth)});
    return node;
  }
  Node any(int depth) {
    const uint64_t kind = random_() % (depth > 0 ? 5 : 3);
    if (kind == 0) return {};
    if (kind == 1) return {.kind = Node::Kind::scalar, .text = std::to_string(random_() % 1000), .quoted = false};
    if (kind == 2) return {.kind = Node::Kind::scalar, .text = text(), .quoted = true};
    if (kind == 3) return map(depth - 1);
    return {.kind = Node::Kind::list, .items = std::vector<Node>(1 + random_() % 3, any(0))};
  }

  double number(const fields::Field& field) {
    const double scale = field.unit == "deg" || field.unit == "deg/s" ? 3.14159265358979 / 180.0 : 1.0;
    const std::optional<double> low = field.above ? field.above : field.at_least;
    const std::optional<double> high = field.below ? field.below : field.at_most;
    const double share = (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53;
    if (low && high) return scale * (*low + share * (*high - *low));
    const double any = std::ldexp(share, static_cast<int>(random_() % 40) - 20);
    if (low) return scale * (*low + any);
    if (high) return scale * (*high - any);
    return scale * (random_() % 2 == 0 ? any : -any);
  }

  std::string text() {
    static constexpr std::string_view kTexts[] = {"",     "a",  "null", "~",     "true",        "3",     "-",
                                                  "a: b", "#x", "a\nb", "\"q\"", "back\\slash", " pad ", "\t",
                                                  "[1]",  "{",  "é",    "\x01",  "use",         "<<",    "1e3"};
    return std::string(kTexts[random_() % std::size(kTexts)]);
  }

  std::mt19937_64 random_;
};

}  // namespace hedgehop::sim
