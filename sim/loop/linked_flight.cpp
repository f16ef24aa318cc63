// The steps of an episode that an autopilot outside this process flies.
#include <fmt/format.h>

#include <utility>
#include <variant>

#include "sim/loop/episode.h"

namespace hedgehop::sim {

/// Lets the autopilot fly from the stand to the start. Collisions count from the stand on.
void Episode::take_off() {
  const double start_within_s = start_of(*scenario_.link).within_s;
  outside_->prepare(pilot_.module().needs(), module_setup(scenario_, environment_.hull));
  aircraft_.reset_on_stand(environment_.collision);
  p_WB_wanted_ = aircraft_.body().p_WB;
  p_WB_wanted_.z() = -scenario_.start.altitude_m;
  proximity_ = environment_.collision.query(aircraft_.X_WB(), kMaxClearanceM, 0.0);
  if (proximity_.collided) {
    throw InputError(FieldError{"link.stand_altitude", "the vehicle on its stand touches an obstacle or the ground"});
  }
  while (!over() && !at_start()) {
    if (outside_step_ > ticks_.ticks(start_within_s)) {
      const std::string awaited = outside_->awaited();
      end({Outcome::link_lost, fmt::format("link: the vehicle did not reach the start within {:g} s{}", start_within_s,
                                           awaited.empty() ? "" : "; awaited: " + awaited)});
      break;
    }
    move_outside();
    if (const std::optional<Ending> fault = fault_of_state()) end(*fault);
    if (over() || aircraft_.on_stand()) continue;
    proximity_ = environment_.collision.query(aircraft_.X_WB(), kMaxClearanceM, 0.0);
    if (const std::optional<Ending> reason = collision()) end(*reason);
  }
  if (!fault_of_state()) aircraft_.begin_linked_flight(environment_.collision);
  if (over()) return;
  flying_ = true;
  outside_->on_start(outside_step_);
}

bool Episode::at_start() const {
  if (aircraft_.on_stand()) return false;
  const dynamics::RigidBodyState& body = aircraft_.body();
  const AutopilotStartConfig& start = start_of(*scenario_.link);
  return (body.p_WB - p_WB_wanted_).norm() <= start.radius_m && body.v_WB_B.norm() <= start.speed_mps;
}

OutsideInput Episode::outside_input() {
  OutsideInput input{.step = outside_step_,
                     .t_ns = std::nullopt,
                     .on_stand = aircraft_.on_stand(),
                     .body = aircraft_.body(),
                     .specific_force_B = aircraft_.specific_force_B(),
                     .wind_W = aircraft_.wind_W(),
                     .beam_distance = aircraft_.beam_distance(environment_.collision, tick_)};
  if (!flying_) return input;
  navigation_ = to_navigation_state(aircraft_.avionics());
  input.t_ns = ticks_.t_ns(tick_);
  input.observation = observation_ ? &*observation_ : nullptr;
  input.navigation = &navigation_;
  input.decision = decision_made_ ? &*decision_made_ : nullptr;
  input.command = pilot_.command_in_effect();
  return input;
}

void Episode::move_outside() {
  const std::variant<OutsideCommand, LinkEnd> answer = outside_->exchange(outside_input());
  if (const auto* const lost = std::get_if<LinkEnd>(&answer)) {
    end({lost->outcome, lost->cause});
    return;
  }
  const StageTimer::Lap lap = physics_.lap();
  aircraft_.command_actuators(std::get<OutsideCommand>(answer));
  aircraft_.move(tick_);
  ++outside_step_;
}

}  // namespace hedgehop::sim
