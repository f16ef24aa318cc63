#pragma once

#include <Eigen/Core>
#include <concepts>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// The kinds of member that `describe(visitor, config)` may list.
namespace hedgehop::fields {

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsVariant : std::false_type {};
template <class... T>
struct IsVariant<std::variant<T...>> : std::true_type {};
template <class T>
struct IsEigenVector : std::false_type {};
template <int N>
struct IsEigenVector<Eigen::Matrix<double, N, 1>> : std::true_type {};

template <class T>
concept VectorField = IsVector<T>::value;
template <class T>
concept OptionalField = IsOptional<T>::value;
template <class T>
concept VariantField = IsVariant<T>::value;
template <class T>
concept EigenField = IsEigenVector<T>::value;
template <class T>
concept NumberField = std::same_as<T, double>;
template <class T>
concept IntegerField = std::integral<T> && !std::same_as<T, bool>;
template <class T>
concept ChoiceField = std::is_enum_v<T>;
/// A map that is stored uninterpreted, for other readers: its type has a kIsOpen.
template <class T>
concept OpenField = requires {
  T::kIsOpen;
};
/// A variant whose alternatives are visible in its own source file only, so that other sources are not recompiled with
/// them: its type has a kIsSealed, and reads, outlines and checks itself.
template <class T>
concept SealedField = requires {
  T::kIsSealed;
};
/// An alternative of a variant that is chosen by one of its keys instead of the variant's selector.
template <class T>
concept ChosenByKey = requires {
  T::kChosenBy;
};
template <class T>
concept StructField =
    std::is_class_v<T> && !OpenField<T> && !SealedField<T> && !VectorField<T> && !OptionalField<T> &&
    !VariantField<T> && !EigenField<T> && !std::same_as<T, std::string> && !std::same_as<T, std::filesystem::path>;

/// Calls `f.operator()<A>()` for each alternative of a variant, in order.
template <class Variant, class F>
void for_each_alternative(F&& f) {
  [&]<size_t... I>(std::index_sequence<I...>) {
    (f.template operator()<std::variant_alternative_t<I, Variant>>(), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>());
}

}  // namespace hedgehop::fields
