// Environments in which a flight cannot be flown end in one line.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/cli/exit_status.h"

namespace hedgehop::sim::cli {
namespace {

using testing::HasSubstr;

TEST(Surroundings, AChangedMesaIsRefusedInOneLine) {
  const CampaignFolder folder;
  const std::string image = "render tiny.yaml --camera front --renderer osmesa -o front.png";
  for (const std::string variable :
       {"MESA_EXTENSION_OVERRIDE='-GL_ARB_framebuffer_object'", "MESA_EXTENSION_OVERRIDE=+GL_none",
        "MESA_EXTENSION_MAX_YEAR=2001", "MESA_GL_VERSION_OVERRIDE=2.1", "MESA_GLSL_VERSION_OVERRIDE=120"}) {
    const CommandEnd end = folder.shell(variable + " " HEDGEHOP_PROGRAM " " + image);
    EXPECT_EQ(end.status, kBadInput) << variable << end.err;
    EXPECT_EQ(std::ranges::count(end.err, '\n'), 1) << variable << end.err;
    EXPECT_THAT(end.err, HasSubstr(variable.substr(0, variable.find('=')) + " is set"));
  }
  EXPECT_EQ(folder
                .shell("MESA_EXTENSION_OVERRIDE=x " HEDGEHOP_PROGRAM
                       " render tiny.yaml --camera front --renderer tiles -o front.png")
                .status,
            0);
}

TEST(Surroundings, ASmallStackIsRefusedInOneLine) {
  const CampaignFolder folder;
  for (const char* kilobytes : {"256", "1024"}) {
    const CommandEnd end =
        folder.shell(std::string("ulimit -s ") + kilobytes + "; " HEDGEHOP_PROGRAM " run tiny.yaml --out out");
    EXPECT_EQ(end.status, kBadInput) << end.err;
    EXPECT_EQ(end.err, std::string("hedgehop: the stack limit is ") + kilobytes +
                           " kB; at least 2048 kB are required (ulimit -s)\n");
  }
  EXPECT_EQ(folder.shell("ulimit -S -s 256; " HEDGEHOP_PROGRAM " run tiny.yaml --out out").status, 0);
}

}  // namespace
}  // namespace hedgehop::sim::cli
