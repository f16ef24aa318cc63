#include "sim/link/recording.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "sim/config/input_error.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim::link {
namespace {

std::vector<uint8_t> bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Recording, HasStepLengthAndBytesInLittleEndian) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "link.bin";
  RecordingWriter writer(file);
  writer.add(0x0102, false, std::vector<uint8_t>{0xaa, 0xbb});
  writer.add(3, true, std::vector<uint8_t>{0xcc});
  EXPECT_EQ(bytes_of(file), (std::vector<uint8_t>{2, 1, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0,    0xaa, 0xbb,  //
                                                  3, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0x80, 0xcc}));
}

TEST(Recording, ReadsBackAsWritten) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "link.bin";
  RecordingWriter writer(file);
  for (int64_t step = 0; step < 1000; ++step) {
    writer.add(step, step % 3 == 0, std::vector<uint8_t>(static_cast<size_t>(step % 70), static_cast<uint8_t>(step)));
  }
  RecordingReader reader(file);
  for (int64_t step = 0; step < 1000; ++step) {
    const RecordedPacket* const packet = reader.peek();
    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->step, step);
    EXPECT_EQ(packet->is_serial, step % 3 == 0);
    EXPECT_EQ(packet->bytes, std::vector<uint8_t>(static_cast<size_t>(step % 70), static_cast<uint8_t>(step)));
    reader.take();
  }
  EXPECT_FALSE(reader.peek());
}

TEST(Recording, MissingOrMalformedFilesAreRefusedWithTheirPlace) {
  EXPECT_THROW(RecordingReader("/absent/link.bin"), InputError);
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "link.bin";
  {
    RecordingWriter writer(file);
    writer.add(0, false, std::vector<uint8_t>(40));
    writer.add(1, false, std::vector<uint8_t>(40));
  }
  std::filesystem::resize_file(file, 100);
  RecordingReader reader(file);
  ASSERT_TRUE(reader.peek());
  reader.take();
  try {
    reader.peek();
    FAIL() << "the cut packet was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("byte 52"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace hedgehop::sim::link
