#include "sim/loop/steering.h"

#include <fmt/format.h>

#include <stdexcept>

#include "dynamics/control/hover_model.h"

namespace hedgehop::sim {
namespace {

using dynamics::multicopter::MulticopterConfig;
using dynamics::multicopter::PerRotor;

void require_in_range(const dynamics::control::RateSetpoint& command, const dynamics::VehicleConfig&) {
  if (!command.w_WB_B.allFinite() || command.w_WB_B.cwiseAbs().maxCoeff() > kMaxBodyRateRadps) {
    throw std::invalid_argument(fmt::format("body rates ({:g}, {:g}, {:g}) rad/s; valid: -{:.4g} .. {:.4g}",
                                            command.w_WB_B.x(), command.w_WB_B.y(), command.w_WB_B.z(),
                                            kMaxBodyRateRadps, kMaxBodyRateRadps));
  }
  if (!(command.thrust >= 0.0 && command.thrust <= 1.0)) {
    throw std::invalid_argument(fmt::format("thrust {:g}; valid: 0 .. 1, a share of the maximum", command.thrust));
  }
}

void require_in_range(const PerRotor& speeds_radps, const dynamics::VehicleConfig& vehicle) {
  const auto* const multicopter = std::get_if<MulticopterConfig>(&vehicle);
  if (!multicopter) throw std::invalid_argument("motor speeds: the vehicle is a helicopter; valid: a multicopter");
  if (speeds_radps.size() != static_cast<Eigen::Index>(multicopter->arms.size())) {
    throw std::invalid_argument(
        fmt::format("{} motor speeds; the vehicle has {} rotors", speeds_radps.size(), multicopter->arms.size()));
  }
  for (const double speed : speeds_radps) {
    if (!(speed >= 0.0 && speed <= multicopter->rotor.highest_radps)) {
      throw std::invalid_argument(
          fmt::format("motor speed {:g} rad/s; valid: 0 .. {:g}", speed, multicopter->rotor.highest_radps));
    }
  }
}

}  // namespace

void require_valid(const DirectCommand& command, const dynamics::VehicleConfig& vehicle) {
  std::visit([&](const auto& given) { require_in_range(given, vehicle); }, command);
}

DirectHover direct_hover(const dynamics::VehicleConfig& vehicle) {
  const dynamics::control::HoverModel model = dynamics::control::make_hover_model(vehicle);
  const double lowest = model.lowest[dynamics::kHeave], highest = model.highest[dynamics::kHeave];
  DirectHover hover{.thrust = (model.trim[dynamics::kHeave] - lowest) / (highest - lowest), .speeds_radps = {}};
  if (const auto* const multicopter = std::get_if<MulticopterConfig>(&vehicle)) {
    hover.speeds_radps = dynamics::multicopter::allocate(make_model(*multicopter), model.trim);
    hover.highest_radps = multicopter->rotor.highest_radps;
  }
  return hover;
}

}  // namespace hedgehop::sim
