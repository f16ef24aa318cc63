#include "dynamics/helicopter/helicopter_hull.h"

#include <stdexcept>

#include "dynamics/helicopter/helicopter.h"

namespace hedgehop::dynamics::helicopter {

std::vector<HullPart> hull(const HelicopterConfig& config) {
  const HelicopterHullConfig& h = config.hull;
  const double R = config.main_rotor.radius_m, R_tr = config.tail_rotor.radius_m;
  const double half_disc = 0.5 * h.disc_thickness_m, half_boom = 0.5 * h.boom_thickness_m;
  const Eigen::Vector3d tail_hub{-config.tail_rotor.arm_m, 0.0, -config.tail_rotor.height_m};

  // The boom runs from the back of the fuselage to the tail rotor, at the height of its hub.
  const double front = h.fuselage_center_B_m.x() - 0.5 * h.fuselage_size_m.x();
  const double half_length = 0.5 * (front - tail_hub.x());
  const std::vector<HullPart> parts = {
      {HullPart::Shape::cylinder, {0.0, 0.0, -config.main_rotor.hub_height_m}, {R, R, half_disc}},
      {HullPart::Shape::box, h.fuselage_center_B_m, 0.5 * h.fuselage_size_m},
      {HullPart::Shape::box, {front - half_length, 0.0, tail_hub.z()}, {half_length, half_boom, half_boom}},
      {HullPart::Shape::box, tail_hub, {R_tr, half_disc, R_tr}}};
  for (const HullPart& part : parts) {
    if (!part.center_B_m.allFinite() || !part.half_extents_m.allFinite() ||
        !(part.half_extents_m.array() > 0.0).all()) {
      throw std::invalid_argument(
          "every part of the hull must have a size: the fuselage must end before the tail rotor");
    }
  }
  return parts;
}

}  // namespace hedgehop::dynamics::helicopter
