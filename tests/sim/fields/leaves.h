#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/fields/bounds.h"

/// Every number, integer and choice of a config, as describe() lists them: to be set one at a time, so that a field
/// that is added is tested without being named.
namespace hedgehop::fields {

/// A value just inside or just outside one side of a field's bounds.
enum class Edge { inside_low, outside_low, inside_high, outside_high, not_a_number };
inline constexpr Edge kEdges[] = {Edge::inside_low, Edge::outside_low, Edge::inside_high, Edge::outside_high,
                                  Edge::not_a_number};

inline bool is_inside(Edge edge) { return edge == Edge::inside_low || edge == Edge::inside_high; }

/// The value at an edge, in the unit of the member; no value if the field has no bound there.
template <class T>
std::optional<T> value_at(Edge edge, const Field& listed) {
  const Field field = bounded(listed);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const bool low = edge == Edge::inside_low || edge == Edge::outside_low;
  const std::optional<double>& exclusive = low ? field.above : field.below;
  const std::optional<double>& inclusive = low ? field.at_least : field.at_most;
  if constexpr (NumberField<T>) {
    if (edge == Edge::not_a_number) return std::nan("");
    if (!exclusive && !inclusive) return {};
    const double written = exclusive ? *exclusive : *inclusive;
    const double bound = is_degrees(field.unit) ? to_radians(written) : written;
    if (is_inside(edge) == inclusive.has_value()) return bound;
    return std::nextafter(bound, low == is_inside(edge) ? kInfinity : -kInfinity);
  } else {
    if (edge == Edge::not_a_number || (!exclusive && !inclusive)) return {};
    const double bound = exclusive ? *exclusive : *inclusive;
    const double step = is_inside(edge) == inclusive.has_value() ? 0.0 : (low == is_inside(edge) ? 1.0 : -1.0);
    const double value = bound + step;
    if (std::is_unsigned_v<T> && value < 0.0) return {};
    return static_cast<T>(value);
  }
}

/// Fills a config so that every kind of leaf is there: optionals hold a value, lists have an item, and variants hold
/// the alternatives that `picks` names, in the order in which they are met.
class Filler {
 public:
  explicit Filler(std::vector<size_t> picks) : picks_(std::move(picks)) {}

  template <class T>
  void operator()(std::string_view, T& value, const Field& field) {
    if constexpr (OptionalField<T>) {
      if (!value) value.emplace();
      (*this)("", *value, field);
    } else if constexpr (VectorField<T>) {
      if (value.empty()) value.emplace_back();
      (*this)("", value.front(), field);
    } else if constexpr (VariantField<T>) {
      const size_t slot = counts.size(), pick = slot < picks_.size() ? picks_[slot] : 0;
      counts.push_back(std::variant_size_v<T>);
      size_t index = 0;
      for_each_alternative<T>([&]<class A>() {
        if (index++ == pick && !std::holds_alternative<A>(value)) value.template emplace<A>();
      });
      std::visit([&](auto& chosen) { describe(*this, chosen); }, value);
    } else if constexpr (StructField<T>) {
      describe(*this, value);
    } else if constexpr (NumberField<T> || IntegerField<T>) {  // an optional's 0 may lie outside
      if (broken_bound(static_cast<double>(value), field)) value = value_at<T>(Edge::inside_high, field).value();
    }
  }

  std::vector<size_t> counts;  ///< alternatives of each variant that was met

 private:
  std::vector<size_t> picks_;
};

/// Calls `use(config)` for each combination of a config's alternatives.
template <class T>
void for_each_filled(const std::function<void(const T&)>& use, std::vector<size_t> picks = {}) {
  T config;
  Filler filler(picks);
  filler("", config, {});
  use(config);
  for (size_t slot = picks.size(); slot < filler.counts.size(); ++slot) {
    std::vector<size_t> next = picks;
    next.resize(slot, 0);
    next.push_back(0);
    for (size_t pick = 1; pick < filler.counts[slot]; ++pick) {
      next.back() = pick;
      for_each_filled(use, next);
    }
  }
}

/// Sets leaf number `target` of a config to an edge, where it has one.
class LeafSetter {
 public:
  LeafSetter(size_t target, Edge edge) : target_(target), edge_(edge) {}

  template <class T>
  void operator()(std::string_view key, T& value, const Field& field) {
    visit(path_.empty() ? std::string(key) : path_ + "." + std::string(key), value, field);
  }

  size_t count() const { return next_; }           ///< of leaves
  const std::string& key() const { return key_; }  ///< of the leaf that was set; empty when it has no such edge

 private:
  template <class T>
  void visit(const std::string& path, T& value, const Field& field) {
    if constexpr (NumberField<T> || IntegerField<T>) {
      if (next_++ != target_) return;
      if (const std::optional<T> edge = value_at<T>(edge_, field)) {
        value = *edge;
        key_ = path;
      }
    } else if constexpr (ChoiceField<T>) {
      if (next_++ != target_ || edge_ != Edge::outside_high) return;
      value = static_cast<T>(field.choices.size());
      key_ = path;
    } else if constexpr (OptionalField<T>) {
      if (value) visit(path, *value, field);
    } else if constexpr (EigenField<T>) {
      for (Eigen::Index i = 0; i < value.size(); ++i) visit(path + "." + std::to_string(i), value[i], field);
    } else if constexpr (VectorField<T>) {
      for (size_t i = 0; i < value.size(); ++i) visit(path + "." + std::to_string(i), value[i], field);
    } else if constexpr (VariantField<T>) {
      std::visit([&](auto& chosen) { enter(path, chosen); }, value);
    } else if constexpr (StructField<T>) {
      enter(path, value);
    }
  }

  template <class T>
  void enter(const std::string& path, T& value) {
    const std::string outer = std::exchange(path_, path);
    describe(*this, value);
    path_ = outer;
  }

  size_t target_, next_ = 0;
  Edge edge_;
  std::string path_, key_;
};

}  // namespace hedgehop::fields
