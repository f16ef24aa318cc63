#include "sim/batch/input_files.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include "sim/config/whole_file.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// A folder of three scenarios, of a result, and of files of other kinds.
class MixedFolder : public TemporaryFolder {
 public:
  MixedFolder() {
    for (const char* file : {"b.yml", "a.yaml", "sub/c.YAML", "sub/deep/d.yaml", "notes.txt", "path.csv",
                             ".hidden.yaml", "out/scenario.yaml", "out/result.json"}) {
      std::filesystem::create_directories((path() / file).parent_path());
      write_file_whole(path() / file, "name: x\n");
    }
  }
  std::vector<std::string> names(const FolderFiles& files) const {
    std::vector<std::string> names;
    for (const auto& file : files.yaml) names.push_back(file.lexically_relative(path()).string());
    return names;
  }
};

TEST(FilesOfAFolder, HaveBothEndings) {
  const MixedFolder folder;
  EXPECT_THAT(folder.names(files_of(folder.path(), false)), ElementsAre("a.yaml", "b.yml"));
}

TEST(FilesOfAFolder, IncludeSubfoldersIfRecursiveButNoResults) {
  const MixedFolder folder;
  const FolderFiles files = files_of(folder.path(), true);
  EXPECT_THAT(folder.names(files), ElementsAre("a.yaml", "b.yml", "sub/c.YAML", "sub/deep/d.yaml"));
  EXPECT_THAT(left_out_words(files, {}), HasSubstr("1 scenarios that flights wrote as results"));
}

TEST(FilesOfAFolder, AreReportedIfLeftOut) {
  const MixedFolder folder;
  const std::string words = left_out_words(files_of(folder.path(), false), {});
  EXPECT_THAT(words, HasSubstr("left out: notes.txt, path.csv (not .yaml or .yml)"));
  EXPECT_THAT(words, HasSubstr("sub/ (2 YAML files; use --recursive)"));
  EXPECT_THAT(words, Not(HasSubstr("hidden")));
}

TEST(FilesOfAFolder, AreNotLeftOutIfAScenarioUsesThem) {
  const MixedFolder folder;
  const auto used = std::filesystem::weakly_canonical(folder.path() / "path.csv");
  EXPECT_THAT(left_out_words(files_of(folder.path(), false), {used}), Not(HasSubstr("path.csv")));
}

TEST(FilesOfAFolder, PartsAreReadLastAndOnlyIfNoScenarioUsesThem) {
  const TemporaryFolder folder;
  write_file_whole(folder.path() / "a_rig.yaml", "cameras: []\n");
  write_file_whole(folder.path() / "b_scene.yaml", "type: urban\n");
  write_file_whole(folder.path() / "c_flight.yaml", "scene: {use: b_scene.yaml}\n");
  std::vector<std::string> read;
  std::set<std::filesystem::path> used;
  read_each(
      files_of(folder.path(), false),
      [&](const std::filesystem::path& file) {
        read.push_back(file.filename().string());
        if (read.back() == "c_flight.yaml")
          used.insert(std::filesystem::weakly_canonical(folder.path() / "b_scene.yaml"));
      },
      [&] { return used; });
  EXPECT_THAT(read, ElementsAre("c_flight.yaml", "a_rig.yaml"));
}

TEST(ModulePaths, AreRelativeToTheFolderOfTheirFile) {
  const auto moved = with_module_paths({"avoidance={plugin: lib/mine.so, module: mine}", "avoidance.plugin=mine.so",
                                        "avoidance={module: mine, plugin: '../a b.so'}", "avoidance.python=mine.py",
                                        "takeover.avoidance={plugin: /abs/mine.so, module: x}"},
                                       "campaigns/x");
  EXPECT_THAT(
      moved,
      ElementsAre("avoidance={plugin: campaigns/x/lib/mine.so, module: mine}", "avoidance.plugin=campaigns/x/mine.so",
                  "avoidance={module: mine, plugin: 'campaigns/a b.so'}", "avoidance.python=campaigns/x/mine.py",
                  "takeover.avoidance={plugin: /abs/mine.so, module: x}"));
}

TEST(ModulePaths, OfOtherOverridesStay) {
  const std::vector<std::string> others = {"avoidance.speed=1", "name=plugin", "vehicle.use=plugin: x.so",
                                           "avoidance={module: zig_zag}", "broken"};
  EXPECT_EQ(with_module_paths(others, "folder"), others);
}

TEST(FilesOfAFolder, AreReadOnceIfALinkLeadsBack) {
  const MixedFolder folder;
  std::filesystem::create_directory_symlink(".", folder.path() / "sub/loop");
  const FolderFiles files = files_of(folder.path(), true);
  EXPECT_THAT(folder.names(files), ElementsAre("a.yaml", "b.yml", "sub/c.YAML", "sub/deep/d.yaml"));
  EXPECT_THAT(left_out_words(files, {}), HasSubstr("sub/loop/ (a link; name the folder itself)"));
}

TEST(FilesOfAFolder, HaveAFaultForEachUnreadableSubfolder) {
  const MixedFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
  std::filesystem::permissions(folder.path() / "sub/deep", std::filesystem::perms::none);
  const bool is_root = geteuid() == 0;  // root may read every folder
  constexpr uid_t kNobody = 65534;
  ASSERT_EQ(is_root ? seteuid(kNobody) : 0, 0);
  const FolderFiles files = files_of(folder.path(), true);
  ASSERT_EQ(is_root ? seteuid(0) : 0, 0);
  std::filesystem::permissions(folder.path() / "sub/deep", std::filesystem::perms::all);
  EXPECT_THAT(folder.names(files), ElementsAre("a.yaml", "b.yml", "sub/c.YAML"));
  EXPECT_THAT(files.faults, ElementsAre(HasSubstr("sub/deep: cannot read this folder: Permission denied")));
}

}  // namespace
}  // namespace hedgehop::sim
