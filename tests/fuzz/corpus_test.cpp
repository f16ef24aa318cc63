#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/mutation.h"
#include "tests/fuzz/readers.h"

namespace hedgehop::fuzz {

/// GoogleTest's, which would print the bytes of a reader, addresses among them.
static void PrintTo(const Reader& reader, std::ostream* out) { *out << reader.name; }

namespace {

std::vector<std::string> corpus(const Reader& reader) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(HEDGEHOP_SOURCE_DIR "/tests/fuzz/corpus/" + std::string(reader.name))) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::vector<std::string> texts;
  for (const std::filesystem::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return texts;
}

class Fuzz : public testing::TestWithParam<Reader> {};

TEST_P(Fuzz, CorpusIsReadOrRefused) {
  const std::vector<std::string> texts = corpus(GetParam());
  ASSERT_FALSE(texts.empty());
  for (const std::string& text : texts) EXPECT_NO_THROW(feed(GetParam(), text)) << text;
}

TEST_P(Fuzz, CorpusHasAFileThatIsReadWhole) {
  const auto reads = [](const std::filesystem::path& file) {
    try {
      GetParam().read(file);
      return true;
    } catch (const std::exception&) {
      return false;
    }
  };
  // They are next to configs/ only in the folder that feed() makes, because a scenario may name ../rigs.
  feed(GetParam(), corpus(GetParam()).front());
  EXPECT_TRUE(reads(std::filesystem::temp_directory_path() / ("hedgehop_fuzz_" + std::to_string(getpid())) / "in" /
                    ("input." + std::string(GetParam().extension))));
}

TEST_P(Fuzz, MutationsOfTheCorpusAreReadOrRefused) {
  const char* const wanted = std::getenv("HEDGEHOP_FUZZ_MUTATIONS");
  const int count = wanted ? std::atoi(wanted) : 300;
  const std::vector<std::string> texts = corpus(GetParam());
  Mutation mutation(1);
  for (int i = 0; i < count; ++i) {
    const std::string text = mutation.of(texts[static_cast<size_t>(i) % texts.size()], texts);
    ASSERT_NO_THROW(feed(GetParam(), text)) << "mutation " << i << ":\n" << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, Fuzz, testing::ValuesIn(readers().begin(), readers().end()),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace hedgehop::fuzz
