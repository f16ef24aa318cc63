#include "sim/link/packet_order.h"

namespace hedgehop::sim::link {
namespace {

// An autopilot that waits in vain repeats after about 1.1 s.
constexpr double kAtOnceS = 0.5;

}  // namespace

PacketOrder::Judgment PacketOrder::judge(uint32_t count, double since_answer_s) {
  if (!last_) {
    last_ = count;
    return Judgment::next;
  }
  if (count == *last_) {
    if (answered_ && since_answer_s < kAtOnceS && ++repeats_at_once_ > 1) return Judgment::refused;
    return Judgment::repeated;
  }
  if (count < *last_) return count == 0 && *last_ > 1 ? Judgment::restart : Judgment::old;
  if (count != *last_ + 1) return Judgment::gap;
  if (!answered_) return Judgment::early;
  last_ = count;
  answered_ = false;
  return Judgment::next;
}

}  // namespace hedgehop::sim::link
