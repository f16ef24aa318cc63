#include <gtest/gtest.h>

#include "sim/logfile/protobuf_schema.h"
#include "sim/logfile/protobuf_writer.h"
#include "tests/sim/logfile/hex.h"

namespace hedgehop::sim {
namespace {

/// The examples of the public description of the encoding.
TEST(ProtobufWriter, FieldsHaveTheBytesOfThePublicExamples) {
  EXPECT_EQ(hex(ProtobufWriter().add_integer(1, 150).bytes()), "089601");
  EXPECT_EQ(hex(ProtobufWriter().add_bytes(2, "testing").bytes()), "120774657374696e67");
  const ProtobufWriter inner = ProtobufWriter().add_integer(1, 150);
  EXPECT_EQ(hex(ProtobufWriter().add_message(3, inner).bytes()), "1a03089601");
}

TEST(ProtobufWriter, NumbersAreLittleEndian) {
  EXPECT_EQ(hex(ProtobufWriter().add_double(1, 1.0).bytes()), "09000000000000f03f");
  EXPECT_EQ(hex(ProtobufWriter().add_fixed32(2, 1).bytes()), "1501000000");
  EXPECT_EQ(hex(ProtobufWriter().add_doubles(16, std::array{1.0}).bytes()), "820108000000000000f03f");
  EXPECT_EQ(hex(ProtobufWriter().add_numbers(2, {1.0, -2.0}).bytes()),
            "1212"
            "09000000000000f03f"
            "1100000000000000c0");
}

/// Seven bits per byte, lowest first: [ProtobufEncoding2024] sec. "Base 128 Varints".
TEST(ProtobufWriter, LargestIntegerHasTenBytes) {
  EXPECT_EQ(hex(ProtobufWriter().add_integer(1, UINT64_MAX).bytes()), "08ffffffffffffffffff01");
}

TEST(ProtobufSchema, UnknownTypeIsNamed) {
  const std::vector<ProtobufMessage> messages = {{"a.B", {{"c", 1, "a.Missing"}}}};
  try {
    file_descriptor_set("a.B", messages);
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "a.Missing: no such message");
  }
}

/// A package that another one needs comes first, with the name that the other one imports.
TEST(ProtobufSchema, PackagesAreInTheOrderOfTheirDependence) {
  const std::vector<ProtobufMessage> messages = {{"a.b.C", {{"d", 1, "z.D"}}}, {"z.D", {{"e", 1, "double"}}}};
  const std::string set = file_descriptor_set("a.b.C", messages);
  const size_t needed = set.find("z.proto"), file = set.find("a/b.proto"), import = set.find("z.proto", file);
  ASSERT_NE(needed, std::string::npos);
  ASSERT_NE(import, std::string::npos);
  EXPECT_LT(needed, file);
}

}  // namespace
}  // namespace hedgehop::sim
