#include "vision/flow/flow_field.h"

#include <algorithm>

namespace hedgehop::vision::flow {

int FlowField::valid_count() const {
  return static_cast<int>(std::count_if(vectors.begin(), vectors.end(), [](const FlowVector& v) { return v.valid; }));
}

double FlowField::valid_share() const {
  return vectors.empty() ? 0.0 : valid_count() / static_cast<double>(vectors.size());
}

}  // namespace hedgehop::vision::flow
