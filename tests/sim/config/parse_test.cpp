#include "sim/config/config_tree.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sample_config.h"
#include "sim/config/whole_file.h"
#include "tests/sim/config/input_files.h"

namespace hedgehop::sim {
namespace {

using sample::Sample;
using testing::ElementsAre;

std::vector<std::string> faults_of_file(const std::string& text) {
  Folder::write("a.yaml", text);
  return faults_of([] { load_struct<Sample>("a.yaml"); });
}

TEST(Parse, MissingFolderAndEmptyFiles) {
  Folder folder;
  EXPECT_THAT(faults_of([] { load_struct<Sample>("no.yaml"); }), ElementsAre("no.yaml: there is no such file"));
  EXPECT_THAT(faults_of([] { load_struct<Sample>("."); }), ElementsAre(".: is a folder, not a file"));
  std::filesystem::create_symlink("loop", "loop");
  EXPECT_THAT(faults_of([] { load_struct<Sample>("loop"); }),
              ElementsAre("loop: cannot be read: Too many levels of symbolic links"));
  EXPECT_THAT(faults_of([] { read_file_whole("loop"); }),
              ElementsAre("loop: cannot be read: Too many levels of symbolic links"));
  EXPECT_THAT(faults_of([] { read_file_whole("no.yaml"); }), ElementsAre("no.yaml: there is no such file"));
  EXPECT_THAT(faults_of_file(""), ElementsAre("a.yaml:1:1: the file is empty"));
  EXPECT_THAT(faults_of_file("# only words\n"), ElementsAre("a.yaml:1:1: the file is empty"));
  EXPECT_THAT(faults_of_file("- 1\n"), ElementsAre("a.yaml:1:1: expected a map of keys, got a list"));
}

TEST(Parse, SyntaxErrorsHaveAPlace) {
  Folder folder;
  EXPECT_THAT(faults_of_file("name: x\nrotor: {radius: 1\n"), ElementsAre(testing::StartsWith("a.yaml:3:1: ")));
  EXPECT_THAT(faults_of_file("name: x\n  mass: 3\n"), ElementsAre(testing::StartsWith("a.yaml:2:7: ")));
}

TEST(Parse, SyntaxErrorsNameTheCause) {
  Folder folder;
  for (const auto& [text, error] : std::vector<std::pair<std::string, std::string>>{
           {"name: note: x\n", "1:11: a second ': ' in this value; put the value in quotes"},
           {"tail: {radius: 1: 2}\n", "1:17: a second ': ' in this value; put the value in quotes"},
           {"name x\nmass: 3\n", "2:5: unexpected ':'; does the line before lack a colon?"},
           {"name: x\n  mass: 3\n", "2:7: unexpected ':'; is this line indented too far?"},
           {"rotor:\n\tradius: 1\n", "2:1: a tab in the indentation; use spaces"},
           {"rotor:\n  radius: 1\n\tblade_count: 2\n", "3:1: a tab in the indentation; use spaces"},
           {"gains:\n\t- 1\n", "2:1: a tab in the indentation; use spaces"},
           {"name: @home\n", "1:7: a value must not begin with '@'; put it in quotes"},
           {"\xef\xbb\xbfname: `x`\n", "1:7: a value must not begin with '`'; put it in quotes"},
           {"name: \"a\"b\nmass: 1\n", "1:10: text after the end of a quoted value"},
           {"name: 'it's'\n", "1:11: text after the end of a quoted value"},
           {"rotor:\n  radius: 1\n mass: 3\n",
            "3:2: this line continues no list and no map above; is its indentation wrong?"},
           {"gains: [1,2\nmass: 1\n", "2:5: ']' is missing; the list begins in line 1"},
           {"gains: [1,2\n", "2:1: ']' is missing; the list begins in line 1"},
           {"gains: [[1, 2] [3, 4]]\n", "1:16: ',' or ']' is missing"},
           {"tail: {radius: 1\nmass: 1\n", "2:5: '}' is missing; the map begins in line 1"},
           {"gains: [1, 2]]\n", "1:14: ']' without the bracket that it closes"},
           {"name: \"abc\nmass: 1\n", "1:7: the closing quote is missing"},
           {"words: ['abc", "1:9: the closing quote is missing"}}) {
    EXPECT_THAT(faults_of_file(text), ElementsAre("a.yaml:" + error)) << text;
  }
  Folder::write("a.yaml", "mass: 1\nname: 'it''s'  # its end\n\n");
  EXPECT_EQ(load_struct<Sample>("a.yaml").name, "it's");
}

TEST(Parse, RefusesInputThatYamlLibrariesAccept) {
  Folder folder;
  EXPECT_THAT(faults_of_file("rotor:\n  radius: 1\n  radius: 2\n"),
              ElementsAre("a.yaml:3:3: duplicate key 'radius' in 'rotor'; first at line 2"));
  EXPECT_THAT(faults_of_file("rotor: {<<: {radius: 1}}\n"),
              ElementsAre("a.yaml:1:9: merge key '<<' in 'rotor' is not allowed; use 'use: file.yaml'"));
  EXPECT_THAT(faults_of_file("name: a\n---\nname: b\n"),
              ElementsAre("a.yaml:3:1: a second document; one file holds one"));
  EXPECT_THAT(faults_of_file("mass: !!int 3\n"), ElementsAre("a.yaml:1:7: tag 'tag:yaml.org,2002:int' is not allowed"));
  EXPECT_THAT(faults_of_file("? [a]\n: 3\n"),
              ElementsAre("a.yaml:1:3: a key in the scenario must be one word, got a list"));
}

TEST(Parse, AliasesAreCopiedButNotWithoutEnd) {
  Folder folder;
  Folder::write("a.yaml", "rotor: &r {radius: 3}\ntail: *r\n");
  EXPECT_EQ(load_struct<Sample>("a.yaml").tail->radius_m, 3.0);
  EXPECT_THAT(faults_of_file("rotors: &r [*r]\n"),
              ElementsAre("a.yaml:1:13: an alias is inside its own anchor",
                          "a.yaml:1:13: 'rotors.0' expects a map of keys, got an empty value"));
  std::string bomb = "words: [";
  for (int i = 0; i < 40; ++i) {
    bomb += i == 0 ? std::string("&w0 [x, x]") : fmt::format(", &w{} [*w{}, *w{}]", i, i - 1, i - 1);
  }
  EXPECT_THAT(faults_of_file(bomb + "]\n"),
              testing::Contains(testing::HasSubstr("aliases make the document too large")));
}

TEST(Use, LaysAMapOverTheFile) {
  Folder folder;
  Folder::write("parts/rotor.yaml", "blade_count: 4\nradius: 2\n");
  Folder::write("base.yaml", "mass: 5\nrotor: {use: parts/rotor.yaml, radius: 3}\ngains: [1, 2, 3]\n");
  Folder::write("top/a.yaml", "use: ../base.yaml\nrotor: {blade_count: 5}\ngains: [7]\n");
  const Sample sample = load_struct<Sample>("top/a.yaml");
  EXPECT_EQ(sample.mass_kg, 5.0);
  EXPECT_EQ(sample.rotor.radius_m, 3.0);
  EXPECT_EQ(sample.rotor.blade_count, 5);
  EXPECT_THAT(sample.gains, ElementsAre(7.0));
}

TEST(Use, FaultsNameTheFileTheyStandIn) {
  Folder folder;
  Folder::write("rotor.yaml", "# a rotor\nradius: -2\n");
  EXPECT_THAT(faults_of_file("mas: 3\nrotor: {use: rotor.yaml, blade_count: 0}\n"),
              ElementsAre(testing::StartsWith("a.yaml:1:1: unknown key 'mas' in the scenario; did you mean 'mass'?"),
                          "a.yaml:2:39: 'rotor.blade_count': must be >= 1, got 0",
                          "rotor.yaml:2:9: 'rotor.radius': must be > 0 m, got -2"));
}

TEST(Use, AnotherChoiceReplacesTheMap) {
  Folder folder;
  Folder::write("base.yaml", "shape: {type: square, side: 3}\n");
  Folder::write("a.yaml", "use: base.yaml\nshape: {type: round}\n");
  EXPECT_EQ(std::get<sample::Round>(load_struct<Sample>("a.yaml").shape).radius_m, 1.0);
}

// A module is chosen by its name, by `python` or by `plugin`, and each takes the place of the others.
TEST(Use, ModulesFromOutsideReplaceThoseOfTheTree) {
  const auto over = [](const std::string& base, const std::string& text) {
    ErrorList faults("scenario");
    Node node = parse_yaml(base, "base.yaml", faults);
    override_with(node, parse_yaml(text, "a.yaml", faults));
    std::vector<std::string> keys;
    for (const Entry& entry : node.entries) keys.push_back(entry.key + "=" + entry.value.text);
    return keys;
  };
  EXPECT_THAT(over("{module: zig_zag, speed: 2}", "{python: m.py, class: A}"), ElementsAre("python=m.py", "class=A"));
  EXPECT_THAT(over("{module: keep, speed: 2}", "{plugin: l.so, module: keep}"),
              ElementsAre("plugin=l.so", "module=keep"));
  EXPECT_THAT(over("{python: m.py, class: A}", "{module: zig_zag}"), ElementsAre("module=zig_zag"));
  EXPECT_THAT(over("{python: m.py, class: A}", "{class: B}"), ElementsAre("python=m.py", "class=B"));
  EXPECT_THAT(over("{module: zig_zag, speed: 2}", "{module: zig_zag, speed: 3}"),
              ElementsAre("module=zig_zag", "speed=3"));
}

TEST(Use, RefusesCirclesAndMissingFiles) {
  Folder folder;
  Folder::write("b.yaml", "rotor: {use: a.yaml}\n");
  EXPECT_THAT(faults_of_file("use: ./b.yaml\n"),
              ElementsAre("b.yaml:1:14: 'use' forms a circle: a.yaml -> b.yaml -> a.yaml"));
  EXPECT_THAT(faults_of_file("use: a.yaml\n"), ElementsAre("a.yaml:1:6: 'use' forms a circle: a.yaml -> a.yaml"));
  EXPECT_THAT(faults_of_file("rotor: {use: c.yaml}\n"), ElementsAre("a.yaml:1:14: there is no such file: 'c.yaml'"));
  EXPECT_THAT(faults_of_file("shape: {use: c.yaml, type: square}\n"),
              ElementsAre("a.yaml:1:14: there is no such file: 'c.yaml'"))
      << "and not that a key is missing";
  EXPECT_THAT(faults_of_file("shape: {use: c.yaml}\n"), ElementsAre("a.yaml:1:14: there is no such file: 'c.yaml'"))
      << "and not that the choice is missing";
  EXPECT_THAT(faults_of_file("rotor: {use: [c]}\n"),
              ElementsAre("a.yaml:1:14: 'use' expects the path of a file, got a list"));
}

class Override : public testing::Test {
 protected:
  Override() { Folder::write("dir/a.yaml", "rotors: [{radius: 1}, {radius: 2}]\nshape: {type: square, side: 3}\n"); }
  static Sample load(const std::vector<std::string>& overrides) { return load_struct<Sample>("dir/a.yaml", overrides); }
  static std::vector<std::string> faults(const std::string& text) {
    return faults_of([&] { load({text}); });
  }
  Folder folder_;
};

TEST_F(Override, SetsScalarsItemsAndWholeValues) {
  const Sample sample =
      load({"mass=3", "rotors.1.radius=7", "rotor.blade_count=5", "gains=[4, 5]", "name=a=b", "tail=~"});
  EXPECT_EQ(sample.mass_kg, 3.0);
  EXPECT_EQ(sample.rotors[0].radius_m, 1.0);
  EXPECT_EQ(sample.rotors[1].radius_m, 7.0);
  EXPECT_EQ(sample.rotor.blade_count, 5);
  EXPECT_THAT(sample.gains, ElementsAre(4.0, 5.0));
  EXPECT_EQ(sample.name, "a=b");
  EXPECT_FALSE(sample.tail);
}

TEST_F(Override, LaterOnesWin) { EXPECT_EQ(load({"mass=3", "mass=4"}).mass_kg, 4.0); }

TEST_F(Override, AnotherChoiceDropsTheOldKeys) {
  EXPECT_EQ(std::get<sample::Round>(load({"shape.type=round", "shape.radius=4"}).shape).radius_m, 4.0);
  EXPECT_EQ(std::get<sample::Square>(load({"shape.type=square"}).shape).side_m, 3.0);
}

TEST_F(Override, ALibraryKeepsItsOwnKeysInAnyOrder) {
  const auto over = [](const std::string& base, const std::vector<std::string>& overrides) {
    ErrorList faults("scenario");
    std::set<std::filesystem::path> read;
    Node node = parse_yaml("avoidance: " + base, "base.yaml", faults);
    apply_overrides(node, overrides, "base.yaml", faults, read);
    EXPECT_TRUE(faults.empty());
    std::vector<std::string> keys;
    for (const Entry& entry : node.find("avoidance")->entries) keys.push_back(entry.key + "=" + entry.value.text);
    return keys;
  };
  const std::string zig_zag = "{module: zig_zag, speed: 2}", library = "{plugin: l.so, module: keep, limit: 1}";
  EXPECT_THAT(over(zig_zag, {"avoidance.plugin=l.so", "avoidance.module=keep"}),
              ElementsAre("module=keep", "plugin=l.so"));
  EXPECT_THAT(over(zig_zag, {"avoidance.module=keep", "avoidance.plugin=l.so"}),
              ElementsAre("module=keep", "plugin=l.so"));
  EXPECT_THAT(over(zig_zag, {"avoidance.plugin=l.so"}), ElementsAre("module=zig_zag", "plugin=l.so"));
  EXPECT_THAT(over("{module: keep, limit: 1}", {"avoidance.sped=3", "avoidance.plugin=l.so"}),
              ElementsAre("module=keep", "limit=1", "sped=3", "plugin=l.so"));
  EXPECT_THAT(over(library, {"avoidance.plugin=m.so", "avoidance.module=hold"}),
              ElementsAre("plugin=m.so", "module=hold", "limit=1"));
  EXPECT_THAT(over(library, {"avoidance.module=zig_zag"}), ElementsAre("module=zig_zag"));
}

TEST_F(Override, UsesAFileInTheFolderOfTheScenario) {
  Folder::write("dir/rotor.yaml", "radius: 9\n");
  EXPECT_EQ(load({"rotor.use=rotor.yaml"}).rotor.radius_m, 9.0);
  EXPECT_EQ(load({"rotors.0={use: rotor.yaml, blade_count: 3}"}).rotors[0].radius_m, 9.0);
}

TEST_F(Override, FaultsNameTheOverride) {
  EXPECT_THAT(faults("rotor.blade_cnt=3"),
              ElementsAre("--set rotor.blade_cnt: unknown key 'blade_cnt' in 'rotor'; did you mean 'blade_count'? "
                          "allowed: blade_count, radius"));
  EXPECT_THAT(faults("rotors.2.radius=3"),
              ElementsAre("--set rotors.2.radius: 'rotors' has no item '2'; it has 2 items, from 0"));
  EXPECT_THAT(faults("rotors.0.radius=-3"),
              ElementsAre("--set rotors.0.radius: 'rotors.0.radius': must be > 0 m, got -3"));
  EXPECT_THAT(faults("shape.type.x=3"),
              ElementsAre("--set shape.type.x: 'shape.type' is the single value 'square'; it has no key 'x'"));
  EXPECT_THAT(faults("mass"), ElementsAre("--set mass: expected key.path=value"));
  EXPECT_THAT(faults("a..b=3"), ElementsAre("--set a..b=3: expected key.path=value"));
  EXPECT_THAT(faults("mass=[1"), ElementsAre("--set mass: '[1' is not a YAML value: ']' is missing"));
  EXPECT_THAT(faults("shape={type: round"),
              ElementsAre("--set shape: '{type: round' is not a YAML value: '}' is missing"));
  EXPECT_THAT(faults("mass="), ElementsAre("--set mass: 'mass' expects a number in kg, got an empty value"));
}

TEST(Suggestion, FindsTheNearestKey) {
  EXPECT_EQ(edit_distance("gian", "gain"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(suggestion("hieght", {"width", "height"}), "; did you mean 'height'? allowed: width, height");
  EXPECT_EQ(suggestion("zzz", {"width", "height"}), "; allowed: width, height");
  EXPECT_EQ(suggestion("x", {}), "; allowed: none");
}

}  // namespace
}  // namespace hedgehop::sim
