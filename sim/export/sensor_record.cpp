#include "sim/export/sensor_record.h"

#include <algorithm>
#include <stdexcept>

namespace hedgehop::sim {

const RecordedState& state_at(const SensorRecord& record, int64_t t_ns) {
  const auto at = std::ranges::lower_bound(record.states, t_ns, {}, &RecordedState::t_ns);
  if (at == record.states.end() || at->t_ns != t_ns) throw std::out_of_range("no state is recorded at this time");
  return *at;
}

}  // namespace hedgehop::sim
