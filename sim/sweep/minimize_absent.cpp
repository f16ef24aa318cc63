#include "sim/config/input_error.h"
#include "sim/sweep/optimize.h"

namespace hedgehop::sim {

std::string minimize(const MinimizeOptions&, const std::function<double(const std::vector<double>&)>&) {
  throw InputError("this build of Hedgehop has no optimizer (hedgehop --version --features)");
}

}  // namespace hedgehop::sim
