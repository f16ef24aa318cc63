// The manual page, the reference page and the completions contain the commands and options of --help.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim {
namespace {

using testing::HasSubstr;

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
  std::set<std::string> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i) found.insert((*i)[1]);
  return found;
}

class Manual : public testing::Test {
 protected:
  /// Returns the completions of bash for a line with an unfinished last word.
  std::string completed(const std::string& line) const {
    const CommandEnd end =
        folder.shell(HEDGEHOP_PROGRAM " manual bash > completion; bash -c '. ./completion; COMP_WORDS=(" + line +
                     "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _hedgehop; echo \"${COMPREPLY[*]}\"'");
    EXPECT_EQ(end.err, "") << line;
    return end.out;
  }
  CampaignFolder folder;
};

TEST_F(Manual, ContainsEveryCommandAndOptionOfHelp) {
  const std::string page = folder.hedgehop("manual man").out, fish = folder.hedgehop("manual fish").out;
  const std::string help = folder.hedgehop("--help").out;
  const std::set<std::string> commands = matches(help.substr(help.find("Subcommands:")), "\n  ([a-z]+) ");
  ASSERT_GE(commands.size(), 13U);
  for (const std::string& command : commands) {
    const size_t begin = page.find(".SS hedgehop " + command + "\n");
    ASSERT_NE(begin, std::string::npos) << command;
    const std::string section = page.substr(begin, page.find(".SS", begin + 1) - begin);
    for (const std::string& option :
         matches(folder.hedgehop(command + " --help").out, "(?:\n  |,)(--?[a-z-]+)[ ,\n]")) {
      EXPECT_THAT(section, HasSubstr("\\fB" + std::regex_replace(option, std::regex("-"), "\\-") + "\\fR")) << command;
      const std::string bare = option.substr(option.find_first_not_of('-'));
      EXPECT_THAT(fish, HasSubstr((option.starts_with("--") ? " -l " : " -s ") + bare)) << command;
    }
  }
}

TEST_F(Manual, ReferencePageHasAnExampleOfEveryCommand) {
  const std::string page = folder.hedgehop("manual markdown").out;
  const std::set<std::string> commands = matches(page, "\n\\| \\[([a-z]+)\\]");
  ASSERT_GE(commands.size(), 13U);
  for (const std::string& command : commands) {
    EXPECT_THAT(page.substr(page.find("\n## " + command + "\n")), HasSubstr("```sh\nhedgehop " + command + " "));
  }
}

TEST_F(Manual, HasNoLineThatRoffWouldReadAsARequest) {
  const std::set<std::string> requests = matches("\n" + folder.hedgehop("manual man").out, "\n[.']([^ \n]*)");
  EXPECT_THAT(requests, testing::IsSubsetOf({"TH", "SH", "SS", "TP", "B", "I", "nf", "fi"}));
}

TEST_F(Manual, BashOffersCommandsOptionsTheirValuesAndFiles) {
  EXPECT_EQ(completed("hedgehop ren"), "render\n");
  EXPECT_EQ(completed("hedgehop run --no-"), "--no-video --no-report\n");
  EXPECT_EQ(completed("hedgehop run --renderer t"), "tiles\n");
  EXPECT_EQ(completed("hedgehop list m"), "modules\n");
  EXPECT_THAT(completed("hedgehop run tin"), HasSubstr("tiny.yaml"));
  EXPECT_EQ(completed("hedgehop --v"), "--version\n");
}

TEST_F(Manual, InstalledShellsReadTheirCompletions) {
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    const CommandEnd end = folder.shell("command -v " + shell + " || exit 77; " HEDGEHOP_PROGRAM " manual " + shell +
                                        " > file; " + shell + " -n file");
    if (end.status == 77) continue;
    EXPECT_EQ(end.status, 0) << shell << ": " << end.err;
  }
}

}  // namespace
}  // namespace hedgehop::sim
