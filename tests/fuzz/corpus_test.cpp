#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "scenes/mesh/model.h"
#include "tests/fuzz/mutation.h"
#include "tests/fuzz/readers.h"

namespace hedgehop::fuzz {

/// GoogleTest's, which would print the bytes of a reader, addresses among them.
static void PrintTo(const Reader& reader, std::ostream* out) { *out << reader.name; }

namespace {

struct CorpusFile {
  std::string name, text;
};

std::vector<CorpusFile> corpus(const Reader& reader) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(HEDGEHOP_SOURCE_DIR "/tests/fuzz/corpus/" + std::string(reader.name))) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::vector<CorpusFile> contents;
  for (const std::filesystem::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    contents.push_back({file.filename().string(), std::string(std::istreambuf_iterator<char>(stream), {})});
  }
  return contents;
}

class Fuzz : public testing::TestWithParam<Reader> {};

TEST_P(Fuzz, CorpusIsReadOrRefused) {
  const std::vector<CorpusFile> files = corpus(GetParam());
  ASSERT_FALSE(files.empty());
  for (const auto& [name, text] : files) {
    bool is_read = false;
    EXPECT_NO_THROW(is_read = feed(GetParam(), text)) << name;
    if (name.find("bad") != std::string::npos) {
      EXPECT_FALSE(is_read) << name;
    }
  }
}

TEST_P(Fuzz, TheFirstFileOfTheCorpusIsReadWhole) {
  if (GetParam().name.starts_with("mesh_") && scenes::mesh::importer_version().empty())
    GTEST_SKIP() << "this build reads no meshes (Debian: apt install libassimp-dev)";
  EXPECT_TRUE(feed(GetParam(), corpus(GetParam()).front().text));
}

TEST_P(Fuzz, MutationsOfTheCorpusAreReadOrRefused) {
  const char* const wanted = std::getenv("HEDGEHOP_FUZZ_MUTATIONS");
  const int count = wanted ? std::atoi(wanted) : 300;
  std::vector<std::string> texts;
  for (const CorpusFile& file : corpus(GetParam())) texts.push_back(file.text);
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
