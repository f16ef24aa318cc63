// Who draws: one word of the command line, of the scenario or of the environment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/sim/cli/ask.h"

namespace hedgehop::sim::cli {
namespace {

using testing::HasSubstr;

class DrawingChoice : public testing::Test {
 protected:
  ~DrawingChoice() override { unsetenv("HEDGEHOP_GL"); }

  /// The scenario that a short run with these options wrote down.
  std::string flown(const std::string& options) {
    const auto folder = std::filesystem::path(testing::TempDir()) / ("drawing_choice_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder);
    const Answer answer = ask("run " HEDGEHOP_SOURCE_DIR
                              "/configs/andert2007_tree_160.yaml --set duration=0.1 --set 'checks=[]' --no-report "
                              "--no-video --out " +
                              folder.string() + " " + options);
    EXPECT_EQ(answer.status, 0) << answer.text;
    std::ostringstream text;
    text << std::ifstream(folder / "scenario.yaml").rdbuf();
    return text.str();
  }
};

TEST_F(DrawingChoice, FirstThatSpeaksCounts) {
  EXPECT_THAT(flown(""), HasSubstr("context: osmesa"));
  setenv("HEDGEHOP_GL", "tiles", 1);
  EXPECT_THAT(flown(""), HasSubstr("context: tiles"));
  EXPECT_THAT(flown("--set drawing.context=osmesa"), HasSubstr("context: osmesa"));
  EXPECT_THAT(flown("--set drawing.context=osmesa --gl tiles"), HasSubstr("context: tiles"));
}

TEST_F(DrawingChoice, UnknownWordIsRefusedInOneLine) {
  EXPECT_EQ(ask("render --info --gl tile").status, kBadInput);
  setenv("HEDGEHOP_GL", "tile", 1);
  const Answer answer = ask("render --info");
  EXPECT_EQ(answer.status, kBadInput);
  EXPECT_EQ(answer.text, "environment variable HEDGEHOP_GL: 'tile' draws nothing; valid: osmesa, egl, tiles\n");
}

TEST_F(DrawingChoice, InfoNamesAllWhoCanDraw) {
  const Answer answer = ask("render --info");
  EXPECT_EQ(answer.status, 0);
  for (const char* name : {"osmesa: ", "egl: ", "tiles: "}) EXPECT_THAT(answer.text, HasSubstr(name));
}

}  // namespace
}  // namespace hedgehop::sim::cli
