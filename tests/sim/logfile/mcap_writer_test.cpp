#include "sim/logfile/mcap_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/sim/logfile/hex.h"

namespace hedgehop::sim {
namespace {

std::string unique(const char* name) { return fmt::format("hedgehop-{}-{}", ::getpid(), name); }

TEST(McapWriter, SmallestFileHasTheBytesOfTheFormat) {
  const WrittenFile file(unique("smallest.mcap"));
  McapWriter(file.path(), {.profile = "", .library = "hh"}).close();
  EXPECT_EQ(hex(file.bytes()),
            "894d434150300d0a"  // magic
            "010a00000000000000"
            "00000000"
            "02000000"
            "6868"  // header
            "0f0400000000000000"
            "7782f7e1"  // end of data, with the CRC of all before
            "021400000000000000"
            "0000000000000000"
            "0000000000000000"
            "b0c9c46f"  // footer
            "894d434150300d0a");
}

/// The records of a message of one byte, uncompressed, each typed from the format's definition.
TEST(McapWriter, MessageHasTheBytesOfTheFormat) {
  const WrittenFile file(unique("message.mcap"));
  McapWriter mcap(file.path(), {.profile = "p", .library = "", .compression = ChunkCompression::none});
  const uint16_t schema = mcap.add_schema("S", "e", "d");
  mcap.write(mcap.add_channel("t", schema, "x", {{"k", "v"}}), 5, "m");
  mcap.close();
  const std::string bytes = hex(file.bytes());
  const std::string records =
      "031100000000000000"
      "0100"
      "0100000053"
      "0100000065"
      "0100000064"  // schema
      "041c00000000000000"
      "0000"
      "0100"
      "0100000074"
      "0100000078"  // channel
      "0a000000"
      "010000006b"
      "0100000076"  // its metadata
      "051700000000000000"
      "0000"
      "00000000"
      "0500000000000000"
      "0500000000000000"
      "6d";  // message
  const size_t at = bytes.find(records);
  ASSERT_NE(at, std::string::npos) << bytes;
  // Message index after the chunk: channel, then time and offset of the message.
  EXPECT_EQ(bytes.substr(at + records.size(), 2 * 31),
            "071600000000000000"
            "0000"
            "10000000"
            "0500000000000000"
            "3f00000000000000");
}

TEST(McapWriter, ChunksEndWithTheFirstMessagePastTheirSize) {
  const WrittenFile file(unique("chunks.mcap"));
  McapWriter mcap(file.path(), {.compression = ChunkCompression::none, .chunk_bytes = 1000});
  const uint16_t channel = mcap.add_channel("t", mcap.add_schema("S", "", ""), "");
  const std::string message(300, 'x');
  for (uint64_t i = 0; i < 30; ++i) mcap.write(channel, i, message);
  mcap.close();
  const std::string bytes = file.bytes();
  size_t chunks = 0;
  for (size_t at = bytes.find(std::string(1, '\x06'), 8); at != std::string::npos; at = bytes.find('\x06', at + 1)) {
    uint64_t uncompressed = 0;
    std::memcpy(&uncompressed, bytes.data() + std::min(at + 25, bytes.size() - 8), 8);
    if (uncompressed >= 1000 && uncompressed < 1000 + 331 + 100) ++chunks;
  }
  EXPECT_EQ(chunks, 7u);  // 4 messages of 331 bytes exceed 1000; the last chunk has 2
}

TEST(McapWriter, UnclosedFileIsAbsent) {
  const WrittenFile file(unique("unclosed.mcap"));
  {
    McapWriter mcap(file.path(), {});
    EXPECT_FALSE(std::filesystem::exists(file.path()));
  }
  EXPECT_FALSE(std::filesystem::exists(file.path()));
}

TEST(McapWriter, FileThatCannotBeWrittenNamesItselfAndTheCause) {
  try {
    McapWriter mcap("/no/such/folder/a.mcap", {});
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "cannot write /no/such/folder/a.mcap: No such file or directory");
  }
}

}  // namespace
}  // namespace hedgehop::sim
