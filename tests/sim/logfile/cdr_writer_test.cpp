#include "sim/logfile/cdr_writer.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/sim/logfile/hex.h"

namespace hedgehop::sim {
namespace {

TEST(CdrWriter, NumbersStartAtMultiplesOfTheirSizeAfterTheHeader) {
  CdrWriter out;
  out.put(uint8_t{1}).put(uint16_t{2}).put(uint8_t{3}).put(int32_t{4}).put(uint8_t{5}).put(1.0);
  EXPECT_EQ(hex(out.bytes()),
            "00010000"  // little endian
            "01"
            "00"
            "0200"
            "03"
            "000000"
            "04000000"
            "05"
            "000000"
            "000000000000f03f");
}

TEST(CdrWriter, TextsHaveTheirLengthAndAZero) {
  CdrWriter out;
  out.put("map").put("").put(uint32_t{7});
  EXPECT_EQ(hex(out.bytes()),
            "00010000"
            "04000000"
            "6d617000"
            "01000000"
            "00"
            "000000"
            "07000000");
}

TEST(CdrWriter, EmptySequenceAlignsItsLengthOnly) {
  CdrWriter out;
  const std::array<double, 0> none = {};
  out.put_length(0).put_array<double>(none).put(uint8_t{9});
  EXPECT_EQ(hex(out.bytes()),
            "00010000"
            "00000000"
            "09");
}

TEST(CdrWriter, SequenceOfDoublesStartsAtAMultipleOfEight) {
  CdrWriter out;
  const std::array one = {1.0};
  out.put_length(1).put_array<double>(one);
  EXPECT_EQ(hex(out.bytes()),
            "00010000"
            "01000000"
            "00000000"
            "000000000000f03f");
}

}  // namespace
}  // namespace hedgehop::sim
