#include "sim/logfile/ulog_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/sim/logfile/hex.h"

namespace hedgehop::sim {
namespace {

TEST(UlogWriter, FileHasTheBytesOfTheFormat) {
  const WrittenFile file(fmt::format("hedgehop-{}-all.ulg", ::getpid()));
  UlogWriter log(file.path(), 7);
  log.add_information("k", "ab");
  const uint16_t topic = log.add_topic("t", "uint8_t x;");
  log.write(topic, 3, "\x05");
  log.write_text(UlogLevel::warning, 4, "hi");
  log.close();
  EXPECT_EQ(hex(file.bytes()),
            "554c6f6701123501"
            "0700000000000000"  // magic, start
            "280042" +
                std::string(80, '0') +  // flags
                "0c0049"
                "09"
                "636861725b325d206b"
                "6162"  // char[2] k
                "1f0046" +
                hex("t:uint64_t timestamp;uint8_t x;") +  // format
                "040041"
                "00"
                "0000"
                "74"  // topic
                "0b0044"
                "0000"
                "0300000000000000"
                "05"  // data
                "0b004c"
                "34"
                "0400000000000000"
                "6869");  // text
}

TEST(UlogWriter, DefinitionAfterDataIsAnError) {
  const WrittenFile file(fmt::format("hedgehop-{}-late.ulg", ::getpid()));
  UlogWriter log(file.path(), 0);
  log.write(log.add_topic("t", "uint8_t x;"), 0, "x");
  EXPECT_THROW(log.add_topic("u", "uint8_t x;"), std::logic_error);
}

}  // namespace
}  // namespace hedgehop::sim
