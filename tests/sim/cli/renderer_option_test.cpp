// The choice of the renderer by the scenario and by the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/sim/cli/ask.h"
#include "tests/sim/record/temporary_folder.h"
#include "tests/sim/render/osmesa.h"

namespace hedgehop::sim::cli {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class RendererOption : public testing::Test {
 protected:
  ~RendererOption() override { unsetenv("HEDGEHOP_GL"); }

  /// Returns the text that `hedgehop run` prints for a short flight. @param options  further options.
  std::string printed_by_run(const std::string& options) {
    std::filesystem::remove_all(out_);
    const Answer answer = ask("run " HEDGEHOP_SOURCE_DIR
                              "/configs/andert2007_tree_160.yaml --set duration=0.1 --set 'checks=[]' --no-report "
                              "--no-video --out " +
                              out_.string() + " " + options);
    EXPECT_EQ(answer.status, 0) << answer.text;
    return answer.text;
  }

  /// Returns the resolved scenario of such a flight.
  std::string resolved(const std::string& options) {
    printed_by_run(options);
    std::ostringstream text;
    text << std::ifstream(out_ / "scenario.yaml").rdbuf();
    return text.str();
  }

  const TemporaryFolder folder_;
  const std::filesystem::path out_ = folder_.path() / "out";
};

TEST_F(RendererOption, CommandLineOverridesTheScenarioWhoseDefaultIsOsmesa) {
  HEDGEHOP_REQUIRE_OSMESA();
  EXPECT_THAT(resolved(""), HasSubstr("renderer: osmesa"));
  EXPECT_THAT(resolved("--set drawing.renderer=tiles"), HasSubstr("renderer: tiles"));
  EXPECT_THAT(resolved("--set drawing.renderer=osmesa --renderer tiles"), HasSubstr("renderer: tiles"));
}

TEST_F(RendererOption, EnvironmentVariableHasNoEffectAndOneLineNamesTheOption) {
  HEDGEHOP_REQUIRE_OSMESA();
  setenv("HEDGEHOP_GL", "tiles", 1);
  EXPECT_THAT(resolved(""), HasSubstr("renderer: osmesa"));
  EXPECT_THAT(printed_by_run(""), StartsWith("warning: HEDGEHOP_GL has no effect any more: use --renderer, or "
                                             "drawing.renderer in the scenario\n"));
}

TEST_F(RendererOption, FormerOptionStillWorksAndPrintsItsNewName) {
  EXPECT_THAT(printed_by_run("--gl tiles"), StartsWith("warning: --gl is deprecated: use --renderer\n"));
  EXPECT_THAT(resolved("--gl tiles"), HasSubstr("renderer: tiles"));
  EXPECT_EQ(ask("render --info --gl tiles --renderer osmesa").status, kBadInput);
  EXPECT_THAT(ask("render --help").text, Not(HasSubstr("Excludes: \n")));  // without the name of the former option
}

TEST_F(RendererOption, RejectsUnknownNamesAndFormerKeysInOneLine) {
  EXPECT_EQ(ask("render --info --renderer tile").status, kBadInput);
  const Answer unknown = ask("render --info --gl tile");
  EXPECT_EQ(unknown.status, kBadInput);
  EXPECT_THAT(unknown.text, StartsWith("--gl: tile not in"));
  const Answer former = ask("run " HEDGEHOP_SOURCE_DIR "/configs/andert2007_tree_160.yaml --set drawing.context=tiles");
  EXPECT_EQ(former.status, kBadInput);
  EXPECT_THAT(former.text, HasSubstr("'context'"));
  EXPECT_THAT(former.text, HasSubstr("its name is now 'renderer'"));
}

TEST_F(RendererOption, InfoListsAllRenderers) {
  const Answer answer = ask("render --info");
  EXPECT_EQ(answer.status, 0);
  for (const char* name : {"osmesa: ", "egl: ", "tiles: "}) EXPECT_THAT(answer.text, HasSubstr(name));
}

}  // namespace
}  // namespace hedgehop::sim::cli
