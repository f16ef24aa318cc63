#include "sim/link/packet_order.h"

#include <gtest/gtest.h>

namespace hedgehop::sim::link {
namespace {

using Judgment = PacketOrder::Judgment;
constexpr double kLater = 1.1;    // s after an answer: an autopilot that waited in vain
constexpr double kAtOnce = 0.01;  // s after an answer

/// An order in which the packets 0 to `last` came, each answered.
PacketOrder after(uint32_t last) {
  PacketOrder order;
  for (uint32_t count = 0; count <= last; ++count) {
    EXPECT_EQ(order.judge(count, kAtOnce), Judgment::next);
    order.answered();
  }
  return order;
}

TEST(PacketOrder, CountsThatRiseByOneAreNext) { EXPECT_EQ(after(5).last(), 5u); }

TEST(PacketOrder, ALinkMayBeginAtAnyCount) {
  PacketOrder order;
  EXPECT_EQ(order.judge(812, 0.0), Judgment::next);
}

TEST(PacketOrder, RepeatsBeforeTheAnswerAreDroppedHoweverMany) {
  PacketOrder order;
  order.judge(0, 0.0);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(order.judge(0, kAtOnce), Judgment::repeated);
  order.answered();
  EXPECT_EQ(order.judge(1, kAtOnce), Judgment::next);
}

TEST(PacketOrder, TwoRepeatsAtOnceAfterTheAnswerAreARefusal) {
  PacketOrder order = after(7);
  EXPECT_EQ(order.judge(7, kAtOnce), Judgment::repeated);
  EXPECT_EQ(order.judge(7, kAtOnce), Judgment::refused);
}

TEST(PacketOrder, RepeatsAfterASecondAreNoRefusal) {
  PacketOrder order = after(7);
  for (int i = 1; i < 10; ++i) EXPECT_EQ(order.judge(7, i * kLater), Judgment::repeated);
  EXPECT_EQ(order.judge(8, kAtOnce), Judgment::next);
}

TEST(PacketOrder, OneRepeatThatCrossedTheAnswerIsForgottenAtTheNextPacket) {
  PacketOrder order = after(3);
  for (uint32_t count = 4; count < 20; ++count) {
    EXPECT_EQ(order.judge(count - 1, kAtOnce), Judgment::repeated);
    EXPECT_EQ(order.judge(count, kAtOnce), Judgment::next);
    order.answered();
  }
}

TEST(PacketOrder, LowerCountsAreOldAndZeroIsARestart) {
  PacketOrder order = after(9);
  EXPECT_EQ(order.judge(4, kAtOnce), Judgment::old);
  EXPECT_EQ(order.judge(8, kLater), Judgment::old);
  EXPECT_EQ(order.judge(0, kLater), Judgment::restart);
}

TEST(PacketOrder, AJumpIsAGap) { EXPECT_EQ(after(811).judge(816, kAtOnce), Judgment::gap); }

TEST(PacketOrder, TheNextPacketBeforeTheAnswerIsEarly) {
  PacketOrder order = after(2);
  EXPECT_EQ(order.judge(3, kAtOnce), Judgment::next);
  EXPECT_EQ(order.judge(4, kAtOnce), Judgment::early);
}

}  // namespace
}  // namespace hedgehop::sim::link
