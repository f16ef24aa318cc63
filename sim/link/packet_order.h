#pragma once

#include <cstdint>
#include <optional>

namespace hedgehop::sim::link {

/// Judges each packet of an autopilot in lockstep by its count. ArduPilot raises the count by one with each answer that
/// it accepts, and sends a count again if no answer came within about a second, or at once if it refuses the answer.
class PacketOrder {
 public:
  enum class Judgment {
    next,      ///< the packet of the next step
    repeated,  ///< of the last step again: dropped
    old,       ///< of an earlier step: dropped
    gap,       ///< packets before it are missing
    restart,   ///< the autopilot began again
    refused,   ///< the autopilot refuses our answer
    early      ///< the next packet before our answer: no lockstep
  };

  /// @param since_answer_s  wall time since answered(); used to recognize refusals only.
  Judgment judge(uint32_t count, double since_answer_s);
  /// Marks the answer to the last packet of Judgment::next.
  void answered() {
    answered_ = true;
    repeats_at_once_ = 0;
  }
  bool is_answered() const { return answered_; }
  /// Returns the count of the last packet of Judgment::next; nullopt before the first.
  std::optional<uint32_t> last() const { return last_; }

 private:
  std::optional<uint32_t> last_;
  bool answered_ = false;
  int repeats_at_once_ = 0;
};

}  // namespace hedgehop::sim::link
