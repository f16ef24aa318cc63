#include "dynamics/plausible_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "dynamics/hull.h"
#include "sim/fields/invalid_field.h"
#include "sim/fields/quantities.h"

namespace hedgehop::dynamics {
namespace {

constexpr double kRadpsPerRpm = 2.0 * std::numbers::pi / 60.0;
constexpr double kSoundMps = 340.0;
constexpr double kSlowTipMps = 20.0;  // chosen: below it no rotor of a few blades lifts its vehicle

/// printf into a std::string.
template <class... T>
std::string text(const char* format, T... values) {
  std::array<char, 200> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

/// Returns advice for a radius that would be plausible in another unit.
std::string radius_advice(double tip_mps, double radius_m) {
  constexpr std::pair<const char*, double> kUnits[] = {{"in", 0.0254}, {"cm", 0.01}, {"mm", 0.001}};
  for (const auto& [unit, meters] : kUnits) {
    const double tip = tip_mps * meters;
    if (tip > kSlowTipMps && tip < kSoundMps) {
      return text("; a radius of %.4g %s is %.4g m", radius_m, unit, radius_m * meters);
    }
  }
  return "";
}

/// @param key  of the speed. @param rpm_key  of the speed in rpm. @param radius_key  of the radius.
void require_tip_speed(const char* key, const char* rpm_key, const char* radius_key, double speed_radps,
                       double radius_m) {
  const double tip_mps = speed_radps * radius_m, tip_by_rpm_mps = tip_mps * kRadpsPerRpm;
  if (!(tip_mps > kSoundMps)) return;
  const bool likely_rpm = tip_by_rpm_mps > kSlowTipMps && tip_by_rpm_mps < kSoundMps;
  if (likely_rpm) {
    throw fields::InvalidField(
        key, text("%.6g: tip speed %.4g m/s, faster than sound; %.6g rpm is %.3g rad/s; did you mean `%s: %.6g`?",
                  speed_radps, tip_mps, speed_radps, speed_radps * kRadpsPerRpm, rpm_key, speed_radps));
  }
  if (const std::string advice = radius_advice(tip_mps, radius_m); !advice.empty()) {
    throw fields::InvalidField(
        radius_key,
        text("%.6g: tip speed %.4g m/s at %.4g rad/s, faster than sound", radius_m, tip_mps, speed_radps) + advice);
  }
  throw fields::InvalidField(key, text("%.6g: tip speed %.4g m/s, faster than sound", speed_radps, tip_mps));
}

void require_chord(const char* key, double chord_m, double radius_m) {
  if (!(chord_m > radius_m)) return;
  std::string advice;
  constexpr std::pair<const char*, double> kUnits[] = {{"cm", 0.01}, {"mm", 0.001}};
  for (const auto& [unit, meters] : kUnits) {
    constexpr double kWideBlade = 0.25;  // of the radius
    if (advice.empty() && chord_m * meters < kWideBlade * radius_m) {
      advice = text("; a chord of %.4g %s is %.4g m", chord_m, unit, chord_m * meters);
    }
  }
  throw fields::InvalidField(key, text("%.4g m: longer than the rotor's radius of %.4g m", chord_m, radius_m) + advice);
}

/// Refuses a hub whose distance from the mass center, in m, is far beyond the main rotor's radius.
void require_hub(const char* key, double place_m, double radius_m) {
  constexpr double kFar = 3.0, kUsual = 1.5;  // radii
  if (!(std::abs(place_m) > kFar * radius_m)) return;
  std::string advice;
  constexpr std::pair<const char*, double> kUnits[] = {{"cm", 0.01}, {"mm", 0.001}};
  for (const auto& [unit, meters] : kUnits) {
    if (advice.empty() && std::abs(place_m) * meters < kUsual * radius_m) {
      advice = text("; %.4g %s is %.4g m", place_m, unit, place_m * meters);
    }
  }
  throw fields::InvalidField(
      key, text("%.4g m: beyond %.0f radii of the main rotor, %.4g m", place_m, kFar, radius_m) + advice);
}

/// Returns advice for an inertia that would have a plausible radius of gyration in another unit.
std::string inertia_advice(double inertia_kgm2, double mass_kg, double size_m) {
  constexpr std::pair<const char*, double> kUnits[] = {{"kg cm2", 1e-4}, {"kg mm2", 1e-6}, {"g cm2", 1e-7}};
  for (const auto& [unit, factor] : kUnits) {
    if (inertia_kgm2 * factor >= mass_kg * size_m * size_m) continue;
    return text("; %.6g %s is %.4g kg m2", inertia_kgm2, unit, inertia_kgm2 * factor);
  }
  return "";
}

/// Refuses the inertia of a rotor or blade that would have it only with more than its share of the vehicle's mass at
/// the blade tip.
void require_rotor_inertia(const char* key, double inertia_kgm2, double share_kg, double radius_m) {
  constexpr double kUsualShare = 0.03;  // above those of all shipped vehicles
  const double largest = share_kg * radius_m * radius_m;
  if (!(inertia_kgm2 > largest)) return;
  throw fields::InvalidField(
      key, text("%.6g: the mass of the vehicle per rotor or blade, %.3g kg, has at most %.3g kg m2 within a radius of "
                "%.4g m",
                inertia_kgm2, share_kg, largest, radius_m) +
               inertia_advice(inertia_kgm2, kUsualShare * share_kg, radius_m));
}

/// @param size_m  radius of a sphere about the mass center that contains the vehicle.
void require_inertia(const MassConfig& mass, double size_m) {
  const double largest = mass.inertia_kgm2.maxCoeff();
  const double gyration_m = std::sqrt(largest / mass.mass_kg);
  constexpr double kRoughHull = 2.0;  // dimensions of the hull are rough
  if (!(gyration_m > kRoughHull * size_m)) return;
  throw fields::InvalidField(
      "mass.inertia", text("%.6g: radius of gyration %.3g m, but the vehicle ends %.3g m from its mass center", largest,
                           gyration_m, size_m) +
                          inertia_advice(largest, mass.mass_kg, size_m));
}

}  // namespace

void require_plausible_units(const helicopter::HelicopterConfig& config) {
  require_tip_speed("main_rotor.speed", "rpm", "main_rotor.radius", config.main_rotor.speed_radps,
                    config.main_rotor.radius_m);
  require_chord("main_rotor.chord", config.main_rotor.chord_m, config.main_rotor.radius_m);
  require_chord("tail_rotor.chord", config.tail_rotor.chord_m, config.tail_rotor.radius_m);
  require_hub("main_rotor.hub_height", config.main_rotor.hub_height_m, config.main_rotor.radius_m);
  require_hub("tail_rotor.arm", config.tail_rotor.arm_m, config.main_rotor.radius_m);
  require_hub("tail_rotor.height", config.tail_rotor.height_m, config.main_rotor.radius_m);
  const double reach_m = config.tail_rotor.arm_m + config.tail_rotor.radius_m;
  require_inertia(config.mass, std::max(config.main_rotor.radius_m, reach_m));
  require_rotor_inertia("main_rotor.blade_inertia", config.main_rotor.blade_inertia_kgm2,
                        config.mass.mass_kg / static_cast<double>(config.main_rotor.blades),
                        config.main_rotor.radius_m);
}

void require_plausible_units(const multicopter::MulticopterConfig& config) {
  require_tip_speed("rotor.highest_speed", "highest_rpm", "rotor.radius", config.rotor.highest_radps,
                    config.rotor.radius_m);
  double longest_m = 0.0;
  for (const multicopter::ArmConfig& arm : config.arms) longest_m = std::max(longest_m, arm.length_m);
  require_inertia(config.mass, longest_m + config.rotor.radius_m);
  require_rotor_inertia("rotor.inertia", config.rotor.inertia_kgm2,
                        config.mass.mass_kg / static_cast<double>(std::max<size_t>(config.arms.size(), 1)),
                        config.rotor.radius_m);
}

std::string mass_unit_advice(double mass_kg, double max_lift_n) {
  constexpr double kFarTooHeavy = 30.0, kGramsPerKg = 1000.0;
  const double weight_n = mass_kg * kGravityMps2;
  if (!(weight_n > kFarTooHeavy * max_lift_n && weight_n < kGramsPerKg * max_lift_n)) return "";
  return text("; a mass of %.6g g is %.4g kg", mass_kg, mass_kg / kGramsPerKg);
}

std::string lift_unit_advice(const multicopter::MulticopterConfig& config) {
  const multicopter::LiftRotorConfig& rotor = config.rotor;
  const double max_lift_n =
      rotor.thrust_ns2 * rotor.highest_radps * rotor.highest_radps * static_cast<double>(config.arms.size());
  constexpr double kPerRpm2 = 1.0 / (kRadpsPerRpm * kRadpsPerRpm), kMaxLift = 6.0;  // 91.2; of the weight, chosen
  const double lift = kPerRpm2 * max_lift_n / (config.mass.mass_kg * kGravityMps2);
  if (!(lift > 1.0 && lift < kMaxLift)) return mass_unit_advice(config.mass.mass_kg, max_lift_n);
  return text("; a thrust of %.4g N per rpm2 is %.4g N s2", rotor.thrust_ns2, rotor.thrust_ns2 * kPerRpm2);
}

std::string azimuth_unit_advice(const std::vector<multicopter::ArmConfig>& arms) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  double written = 0.0;
  for (const multicopter::ArmConfig& arm : arms) {
    const double azimuth = arm.azimuth_rad * kDegPerRad;
    if (std::abs(azimuth) > kTurn) return "";
    if (written == 0.0) written = azimuth;
  }
  return written == 0.0 ? "" : text("; %.3g rad is %.3g deg", written, written * kDegPerRad);
}

std::string rotor_speed_advice(const helicopter::MainRotor& rotor, double weight_n) {
  const double tip_mps = rotor.disc.tip_speed_mps / kRadpsPerRpm;
  const double max_lift_n = rotor.disc.max_thrust_n / (kRadpsPerRpm * kRadpsPerRpm);  // as the square of the speed
  if (!(tip_mps < kSoundMps && weight_n > rotor.disc.max_thrust_n && weight_n < max_lift_n)) return "";
  const double rpm = rotor.speed_radps / kRadpsPerRpm;
  return text("; %.4g rpm is %.3g rad/s; did you mean `speed: %.4g`?", rpm, rotor.speed_radps, rpm);
}

std::string stop_unit_advice(double lowest_rad, double highest_rad) {
  constexpr double kMaxDeg = 0.8;  // 0.8 rad is 45 deg
  const double written = highest_rad * kDegPerRad;
  if (!(written > 0.0 && written < kMaxDeg && std::abs(lowest_rad) * kDegPerRad < kMaxDeg)) return "";
  return text("; %.3g rad is %.3g deg", written, written * kDegPerRad);
}

}  // namespace hedgehop::dynamics
