#include "sim/flight/flight.h"

namespace hedgehop::sim {

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::reached:
      return "reached";
    case Outcome::collided:
      return "collided";
    case Outcome::timeout:
      return "timeout";
    case Outcome::fault:
      return "fault";
  }
  return "fault";
}

std::string_view to_string(FigureKind kind) {
  switch (kind) {
    case FigureKind::judged:
      return "judged";
    case FigureKind::module:
      return "module";
    case FigureKind::wall_time:
      return "wall_time";
  }
  return "judged";
}

}  // namespace hedgehop::sim
