#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "sim/libm/many.h"
#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

// The oracle is the long double of the C library, with 11 more bits, which these functions do not replace.
struct Function {
  template <class F>
  Function(const char* its_name, F f) : name(its_name), value(f), exact(f), single(f) {}
  const char* name;
  double (*value)(double);
  long double (*exact)(long double);
  float (*single)(float);
};
const std::vector<Function> kFunctions = {
    {"sin", [](auto x) { return std::sin(x); }},     {"cos", [](auto x) { return std::cos(x); }},
    {"tan", [](auto x) { return std::tan(x); }},     {"asin", [](auto x) { return std::asin(x); }},
    {"acos", [](auto x) { return std::acos(x); }},   {"atan", [](auto x) { return std::atan(x); }},
    {"exp", [](auto x) { return std::exp(x); }},     {"exp2", [](auto x) { return std::exp2(x); }},
    {"expm1", [](auto x) { return std::expm1(x); }}, {"log", [](auto x) { return std::log(x); }},
    {"log2", [](auto x) { return std::log2(x); }},   {"log10", [](auto x) { return std::log10(x); }},
    {"log1p", [](auto x) { return std::log1p(x); }}, {"cbrt", [](auto x) { return std::cbrt(x); }},
    {"tanh", [](auto x) { return std::tanh(x); }}};
struct Function2 {
  template <class F>
  Function2(const char* its_name, F f) : name(its_name), value(f), exact(f), single(f) {}
  const char* name;
  double (*value)(double, double);
  long double (*exact)(long double, long double);
  float (*single)(float, float);
};
const std::vector<Function2> kFunctions2 = {{"atan2", [](auto y, auto x) { return std::atan2(y, x); }},
                                            {"hypot", [](auto x, auto y) { return std::hypot(x, y); }},
                                            {"pow", [](auto x, auto y) { return std::pow(x, y); }}};

/// Returns the distance in units of the last place of `exact`, rounded to T; 0 for equal infinities, zeros of equal
/// sign, and two NaN.
template <class T>
double ulps(T value, long double exact) {
  const T rounded = static_cast<T>(exact);
  if (std::isnan(rounded) || std::isnan(value)) return std::isnan(rounded) && std::isnan(value) ? 0.0 : HUGE_VAL;
  if (std::isinf(rounded) || std::isinf(value)) return rounded == value ? 0.0 : HUGE_VAL;
  if (rounded == T{0} && value == T{0}) return std::signbit(rounded) == std::signbit(value) ? 0.0 : HUGE_VAL;
  const T magnitude = std::abs(rounded);
  const T unit = std::nextafter(magnitude, std::numeric_limits<T>::infinity()) - magnitude;
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact) / static_cast<long double>(unit));
}

template <class T>
std::vector<T> arguments(int count) {
  using Bits = std::conditional_t<sizeof(T) == 8, uint64_t, uint32_t>;
  using Limits = std::numeric_limits<T>;
  std::vector<T> list;
  for (const T x : {T(0), T(0.5), T(1), T(2), T(3), T(1e5), T(1e22), T(1e-20), Limits::min(), Limits::denorm_min(),
                    Limits::max(), Limits::infinity()}) {
    list.push_back(x);
    list.push_back(-x);
  }
  list.push_back(Limits::quiet_NaN());
  std::mt19937_64 random(1);
  for (int i = 0; i < count; ++i) {
    list.push_back(std::bit_cast<T>(static_cast<Bits>(random())));                          // any bits
    list.push_back(static_cast<T>(std::ldexp(static_cast<double>(random()), -58) - 32.0));  // -32 to 32
    list.push_back(static_cast<T>(std::ldexp(static_cast<double>(random()), -63) - 1.0));   // -1 to 1
  }
  return list;
}

constexpr double kBoundUlp = 1.0 + 1e-3;     // bound of SLEEF, and rounding of the oracle
constexpr double kSubnormalUlp = 1.0 + 0.5;  // if an intermediate result is subnormal

template <class T>
double bound(long double exact) {
  return std::abs(exact) < 4 * std::numeric_limits<T>::min() ? kSubnormalUlp : kBoundUlp;
}

TEST(Libm, FunctionsAreWithinOneUlpOfLongDoubleForEveryArgument) {
  for (const Function& f : kFunctions) {
    for (const double x : arguments<double>(30000)) {
      const long double exact = f.exact(x);
      ASSERT_LE(ulps(f.value(x), exact), bound<double>(exact)) << f.name << " of " << x;
    }
    for (const float x : arguments<float>(30000)) {
      const long double exact = f.exact(x);
      ASSERT_LE(ulps(f.single(x), exact), bound<float>(exact)) << f.name << " of the float " << x;
    }
  }
}

TEST(Libm, FunctionsOfTwoArgumentsAreWithinOneUlpOfLongDouble) {
  std::mt19937_64 random(2);
  for (const Function2& f : kFunctions2) {
    const std::vector<double> doubles = arguments<double>(30000);
    const std::vector<float> floats = arguments<float>(30000);
    for (std::size_t i = 0; i < doubles.size(); ++i) {
      for (const std::size_t j : {i % 25, random() % doubles.size()}) {
        const long double exact = f.exact(doubles[i], doubles[j]), exact_single = f.exact(floats[i], floats[j]);
        ASSERT_LE(ulps(f.value(doubles[i], doubles[j]), exact), bound<double>(exact))
            << f.name << " of " << doubles[i] << " and " << doubles[j];
        ASSERT_LE(ulps(f.single(floats[i], floats[j]), exact_single), bound<float>(exact_single))
            << f.name << " of the floats " << floats[i] << " and " << floats[j];
      }
    }
  }
}

TEST(Libm, SincosEqualsSineAndCosine) {
  for (const double x : arguments<double>(10000)) {
    if (!std::isfinite(x)) continue;
    double sine = 0.0, cosine = 0.0;
    sincos(x, &sine, &cosine);
    volatile double alone = x;  // so that the compiler does not call sincos
    EXPECT_EQ(std::bit_cast<uint64_t>(sine), std::bit_cast<uint64_t>(std::sin(alone))) << x;
    EXPECT_EQ(std::bit_cast<uint64_t>(cosine), std::bit_cast<uint64_t>(std::cos(alone))) << x;
  }
}

/// Hash of the bits of all results.
uint64_t digest() {
  Fnv1a hash;
  const auto add = [&hash](auto result) {
    if (std::isnan(result)) result = std::numeric_limits<decltype(result)>::quiet_NaN();  // the same NaN for all
    for (const char byte : std::bit_cast<std::array<char, sizeof result>>(result)) {
      hash.add(static_cast<unsigned char>(byte));
    }
  };
  for (const Function& f : kFunctions) {
    for (const double x : arguments<double>(10000)) add(f.value(x));
    for (const float x : arguments<float>(10000)) add(f.single(x));
  }
  const std::vector<double> x = arguments<double>(10000);
  for (const Function2& f : kFunctions2) {
    for (std::size_t i = 1; i < x.size(); ++i) add(f.value(x[i - 1], x[i]));
  }
  return hash.value();
}

// Recorded, so that all machines must have the same bits. Another version of SLEEF may change them.
TEST(Libm, ResultsHaveTheRecordedBits) { EXPECT_EQ(digest(), 9242769149961318195U); }

TEST(Libm, ManyNumbersHaveTheBitsOfSingleCalls) {
  constexpr double kInf = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();
  std::mt19937_64 random(3);
  for (size_t count = 0; count < 40; ++count) {
    std::vector<double> a(count), b(count), angles(count);
    for (size_t i = 0; i < count; ++i) {
      a[i] = uniform(random, -3.0, 3.0);
      b[i] = uniform(random, -3.0, 3.0);
      constexpr double kSpecial[] = {0.0, -0.0, kInf, -kInf, kNaN, 1e-310, 1e300};
      if (chance(random, 0.2)) a[i] = kSpecial[random() % 7];
      if (chance(random, 0.2)) b[i] = kSpecial[random() % 7];
    }
    atan2_of_each(a, b, angles);
    for (size_t i = 0; i < count; ++i) {
      EXPECT_EQ(std::bit_cast<uint64_t>(angles[i]), std::bit_cast<uint64_t>(std::atan2(a[i], b[i]))) << a[i] << b[i];
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim
