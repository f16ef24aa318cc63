#include "sim/campaign/optimize.h"
#include "sim/scenario/input_error.h"

namespace hedgehop::sim {

Optimum optimize(const SweepConfig&, const FlyPoint&) {
  throw InputError("this build of Hedgehop has no optimizer (hedgehop --version --features)");
}

}  // namespace hedgehop::sim
