// Files that are not a scenario, a mesh or a result lead to one clear error line within a short time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <string>

#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/cli/exit_status.h"

namespace hedgehop::sim {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;

class BadFile : public testing::Test {
 protected:
  /// Processor time is limited. A command that does not end is killed, and its status is then not 2.
  CommandEnd run(const std::string& arguments) const {
    return folder.shell("ulimit -t 20; " HEDGEHOP_PROGRAM " run " + arguments + " --no-video --out out");
  }
  void refused(const std::string& arguments, const std::string& why) const {
    const CommandEnd end = run(arguments);
    EXPECT_EQ(end.status, kBadInput) << end.err.substr(0, 300);
    EXPECT_THAT(end.err, HasSubstr(why));
    EXPECT_LT(end.err.size(), 20'000U);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
  }
  CampaignFolder folder;
};

TEST_F(BadFile, RejectsPipesDevicesFoldersAndHugeFilesAsScenarios) {
  folder.shell("mkfifo pipe; truncate -s 70M huge.yaml");
  refused("pipe", "pipe: is a device or a pipe, not a file");
  refused("/dev/zero", "/dev/zero: is a device or a pipe, not a file");
  refused(".", "is a folder, not a file");
  refused("huge.yaml", "huge.yaml: is larger than 64 MB");
  folder.write("uses.yaml", "use: pipe\n");
  refused("uses.yaml", "uses.yaml:1:6: is a device or a pipe, not a file: 'pipe'");
  folder.shell("ln -s loop loop");
  refused("loop", "loop: cannot be read: Too many levels of symbolic links");
  folder.write("vehicle.yaml", "use: gone.yaml\nmass: {mass: 1}\nmain_rotor: {radius: 1}\n");
  const CommandEnd vehicle = folder.hedgehop("validate vehicle.yaml");
  EXPECT_EQ(vehicle.err, "vehicle.yaml:1:6: there is no such file: 'gone.yaml'\n");
}

TEST_F(BadFile, APipeDoesNotBlockAnyCommand) {
  folder.write("sweep.yaml",
               "scenario: tiny.yaml\nseeds: 1\ntuned_on: 1:2000\ndesign: {type: grid}\n"
               "parameters: [{path: start.east, values: [0, 0.1]}]\n");
  ASSERT_EQ(folder.hedgehop("batch tiny.yaml --seeds 3 --out flown").status, 0);
  ASSERT_EQ(folder.hedgehop("sweep sweep.yaml --out swept").status, 0);
  folder.shell("mkfifo pipe pipe.yaml");
  const std::string run = "flown/tiny/seed3/";
  const auto stopped = [&](const std::string& arguments) {
    const CommandEnd end = folder.shell("timeout 20 " HEDGEHOP_PROGRAM " " + arguments);
    EXPECT_EQ(end.status, kBadInput) << arguments << ": " << end.err;
    EXPECT_THAT(end.err, HasSubstr("pipe")) << arguments;
    EXPECT_EQ(std::ranges::count(end.err, '\n'), 1) << arguments << ": " << end.err;
  };
  stopped("batch --plan pipe");
  stopped("reproduce ./pipe.yaml");
  stopped("run tiny.yaml --set 'avoidance={plugin: pipe, module: mine}'");
  for (const std::string file : {"result.json", "trajectory.csv", "decisions.csv", "scenario.yaml"}) {
    folder.shell("mv " + run + file + " kept; ln -s $PWD/pipe " + run + file);
    const CommandEnd end = folder.shell("timeout 20 " HEDGEHOP_PROGRAM " report " + run);
    EXPECT_EQ(end.status, kBadInput) << file << ": " << end.err;
    EXPECT_THAT(end.err, HasSubstr(file + ": is a device or a pipe, not a file"));
    folder.shell("mv kept " + run + file);
  }
  folder.shell("ln -sf $PWD/pipe flown/batch.json; ln -sf $PWD/pipe flown/batch.csv; ln -sf $PWD/pipe swept/sweep.csv");
  for (const std::string command :
       {"batch --failed-only --out flown", "batch tiny.yaml --no-worse-than flown --out out", "report flown",
        "report swept"}) {
    EXPECT_EQ(folder.shell("timeout 20 " HEDGEHOP_PROGRAM " " + command).status, kBadInput) << command;
  }
}

TEST_F(BadFile, NamesTheKindOfAFileOfAnotherKind) {
  const std::string configs = HEDGEHOP_SOURCE_DIR "/configs/";
  for (const auto& [file, kind] :
       std::map<std::string, std::string>{{"vehicles/s900.yaml", "a vehicle"},
                                          {"rigs/local_map.yaml", "a rig"},
                                          {"papers/zingg2010.yaml", "a paper"},
                                          {"campaigns/failures.yaml", "a campaign"},
                                          {"campaigns/leaderboard.yaml", "a campaign"},
                                          {"sweeps/garratt2009_room_gains.yaml", "a sweep"},
                                          {"falsify/gps_offset.yaml", "a sweep or a search"}}) {
    const CommandEnd end = run(configs + file);
    EXPECT_EQ(end.status, kBadInput);
    EXPECT_THAT(end.err, HasSubstr("is not a scenario but " + kind)) << end.err;
    EXPECT_EQ(std::ranges::count(end.err, '\n'), 1) << end.err;
  }
}

TEST_F(BadFile, SweepNamesTheKindOfAFileOfAnotherKind) {
  for (const auto& [file, kind] : std::map<std::string, std::string>{
           {HEDGEHOP_SOURCE_DIR "/configs/vehicles/s900.yaml", "a vehicle"}, {"tiny.yaml", "a scenario"}}) {
    const CommandEnd end = folder.hedgehop("sweep " + file + " --out out");
    EXPECT_EQ(end.status, kBadInput);
    EXPECT_THAT(end.err, HasSubstr("is not a sweep but " + kind)) << end.err;
    EXPECT_EQ(std::ranges::count(end.err, '\n'), 1) << end.err;
  }
}

TEST_F(BadFile, ListsTheKindsOfFilesIfItIsOfNone) {
  folder.write("runs.yaml", "description: a wrong word\nruns: [{scenario: tiny.yaml, seeds: 1:3}]\n");
  const CommandEnd end = run("runs.yaml");
  EXPECT_EQ(end.status, kBadInput);
  EXPECT_THAT(end.err, HasSubstr("runs.yaml:1:1: is no file of Hedgehop"));
  EXPECT_THAT(end.err, HasSubstr("a campaign (flights or leaderboard)"));
  EXPECT_EQ(std::ranges::count(end.err, '\n'), 1) << end.err;
}

TEST_F(BadFile, RejectsHugeDocumentsBeforeReadingThem) {
  std::string keys = "use: tiny.yaml\n", list = "use: tiny.yaml\nroute: [", open;
  for (int i = 0; i < 100'000; ++i) keys += "key" + std::to_string(i) + ": 1\n";
  for (int i = 0; i < 300'000; ++i) list += "1,";
  for (int i = 0; i < 1'900'000; ++i) open += "[{";
  folder.write("keys.yaml", keys);
  folder.write("list.yaml", list + "]\n");
  folder.write("word.yaml", std::string(1'000'000, 'a'));
  folder.write("open.yaml", open);
  folder.write("deep.yaml", std::string(100'000, '['));
  folder.write("long.yaml", std::string(60'000'000, '\n'));
  refused("open.yaml", "open.yaml:1:1: more than 200000 lists and maps");
  refused("deep.yaml", "lists and maps are nested too deeply");
  refused("long.yaml", "long.yaml:1:1: more than 4 MB of YAML");
  refused("keys.yaml", "more than 2000 keys in the scenario");
  refused("list.yaml", "more than 200000 values in one file");
  refused("word.yaml", "expected a map of keys, got 'aaaa");
}

TEST_F(BadFile, CountsAThousandErrorsInsteadOfListingThem) {
  std::string keys = "use: tiny.yaml\n";
  for (int i = 0; i < 1000; ++i) keys += "key" + std::to_string(i) + ": 1\n";
  folder.write("keys.yaml", keys);
  refused("keys.yaml", "and 950 more");
}

TEST_F(BadFile, RejectsPipesAndOtherFormatsNamedByAMesh) {
  folder.shell("mkfifo pipe.mtl; truncate -s 3G huge.mtl; mkfifo buffer; mkfifo pipe.obj");
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  folder.write("piped.obj", "mtllib pipe.mtl\n" + triangle);
  folder.write("huge.obj", "mtllib huge.mtl\n" + triangle);
  folder.write("piped.gltf",
               R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "buffers": [{"uri": "buffer", "byteLength": 36}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}]})");
  std::string faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", fbx = "; FBX 7.4.0 project file\n";
  for (int i = 0; i < 3'000'000; ++i) faces += "f 1 2 3\n";
  for (int i = 0; i < 100'000; ++i) fbx += "a: {\n";
  std::string nodes = "{\"children\": [1]}";
  for (int i = 2; i < 100'000; ++i) nodes += ", {\"children\": [" + std::to_string(i) + "]}";
  folder.write("chain.gltf",
               R"({"asset": {"version": "2.0"}, "nodes": [)" + nodes + R"(, {}], "scenes": [{"nodes": [0]}]})");
  folder.write("faces.obj", faces);
  for (const char* name : {"deep.fbx", "deep.obj", "deep.gltf", "deep.glb"}) folder.write(name, fbx);
  const auto with = [](const std::string& file) { return "tiny.yaml --set 'scene.imports=[{file: " + file + "}]'"; };
  refused(with("pipe.obj"), "pipe.obj': it is not a regular file");
  refused(with("piped.obj"), "pipe.mtl' is not a regular file of at most 256 MB");
  refused(with("huge.obj"), "huge.mtl' is not a regular file of at most 256 MB");
  refused(with("piped.gltf"), "buffer' is not a regular file of at most 256 MB");
  refused(with("faces.obj"), "it has more than 2000000 triangles");
  refused(with("chain.gltf"), "it has no triangles");
  refused(with("deep.fbx"),
          "its suffix '.fbx' is unknown; valid: .obj, .gltf, .glb, .dae, .ply, .stl; of a world: .sdf, .world\n");
  refused(with("deep.fbx"), "'scene.imports.0.file': '");
  for (const char* name : {"deep.obj", "deep.gltf", "deep.glb"}) refused(with(name), std::string(name) + "': ");
}

TEST_F(BadFile, RejectsMeshesThatTheImporterCannotRead) {
  std::ofstream folded(folder.path() / "folded.obj");
  folded << "v 0 0 0\nv 1 0 0\nv 0 1 0\n  f";
  for (int i = 0; i < 20'000; ++i) folded << (i % 100 == 99 ? "\\\n" : "\t") << i % 3 + 1;
  folded.close();
  std::ofstream polygon(folder.path() / "polygon.obj"), deep(folder.path() / "deep.gltf"),
      far(folder.path() / "far.obj");
  polygon << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
  for (int i = 0; i < 20'000; ++i) polygon << ' ' << i % 3 + 1;
  deep << R"({"asset": {"version": "2.0"}, "x": )" << std::string(200'000, '[') << std::string(200'000, ']') << "}";
  far << "v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n";
  polygon.close();
  deep.close();
  far.close();
  const auto with = [](const std::string& file) { return "tiny.yaml --set 'scene.imports=[{file: " + file + "}]'"; };
  refused(with("polygon.obj"), "it has a face of more than 1000 corners");
  refused(with("folded.obj"), "folded.obj': ");
  refused(with("deep.gltf"), "its JSON is nested deeper than 200");
  refused(with("far.obj"), "it has corners farther than 100 km from the origin");
}

TEST_F(BadFile, ANameCannotLeaveTheFolder) {
  for (const char* name : {"../../x", "a/b", ".hidden", "\"a\\nb\""}) {
    refused("tiny.yaml --set 'name=" + std::string(name) + "'", "'name': must not ");
  }
}

TEST_F(BadFile, RejectsAStartInAWallOrOutsideTheRoom) {
  refused("tiny.yaml --set start.north=8", "'start': the vehicle collides at the start: hit");
  refused("tiny.yaml --set start.north=50", "'start': is outside the room, which is 16 m long");
  refused("tiny.yaml --set start.altitude=0", "'start': the vehicle collides at the start: hit the ground");
}

TEST_F(BadFile, ReportsAnUnwritableFolderBeforeTheFlight) {
  folder.write("file", "");
  const CommandEnd end = folder.hedgehop("run tiny.yaml --no-video --out file/below");
  EXPECT_EQ(end.status, kBadInput);
  EXPECT_THAT(end.err, AllOf(HasSubstr("file/below: cannot write results"), HasSubstr("Not a directory")));
  folder.shell("ln -s missing link");
  EXPECT_THAT(folder.hedgehop("run tiny.yaml --out link/below").err,
              HasSubstr("/link: is a link to a missing folder\n"));
  ASSERT_EQ(folder.hedgehop("run tiny.yaml --no-video --no-report --out flown").status, 0);
  for (const std::string& command :
       {std::string("run tiny.yaml --out /proc/nope"), "batch tiny.yaml --seeds 3 --out " + std::string(300, 'x'),
        std::string("export flown --format euroc --out file"),
        std::string("export flown --format tum --out /proc/nope"),
        std::string("batch tiny.yaml --seeds 3 --out out --junit file/below.xml"),
        std::string("batch tiny.yaml --seeds 3 --out out --junit flown"), std::string("run tiny.yaml --out link/below"),
        std::string("render tiny.yaml --camera front -o file/below.png")}) {
    const CommandEnd refusal = folder.hedgehop(command);
    EXPECT_EQ(refusal.status, kBadInput) << command << ": " << refusal.err;
    EXPECT_EQ(std::ranges::count(refusal.err, '\n'), 1) << command << ": " << refusal.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out")) << command;
  }
}

TEST_F(BadFile, WritesIntoADeviceWithoutReplacingIt) {
  folder.shell("mkfifo pipe; cat pipe >read & true");
  EXPECT_EQ(folder.hedgehop("trim " HEDGEHOP_SOURCE_DIR "/configs/vehicles/s900.yaml --plot pipe").status, 0);
  EXPECT_TRUE(std::filesystem::is_fifo(folder.path() / "pipe"));
}

TEST_F(BadFile, AnErrorIsOneLine) {
  for (const std::string& arguments :
       {std::string("run $'a\nb.yaml'"), std::string("run tiny.yaml --set $'a\nb=1'"),
        std::string("run tiny.yaml --set 'scene.imports=[{file: \"a\\nb\"}]'"),
        std::string("run tiny.yaml --seed $'1\n2'"), std::string("batch tiny.yaml --until $'colli\nsion < 0.1'"),
        std::string("bless tiny"), std::string("reproduce missing.yaml"), std::string("run"), std::string("fly")}) {
    folder.write("command", HEDGEHOP_PROGRAM " " + arguments + "\n");
    const CommandEnd end = folder.shell("bash command");
    EXPECT_EQ(end.status, kBadInput) << arguments;
    EXPECT_EQ(std::ranges::count(end.err, '\n'), 1) << arguments << ": " << end.err;
  }
}

TEST_F(BadFile, AMalformedResultIsNamedAndFlownAgain) {
  ASSERT_EQ(folder.hedgehop("batch tiny.yaml --seeds 3 --out out").status, 0);
  const std::string whole = folder.read("out/tiny/seed3/result.json");
  const std::string hash = folder.json("out/tiny/seed3/result.json")["trajectory_hash"];
  for (const char* bad : {"[]", "null", "3", "{", R"({"checks": null})", R"({"outcome": 3})"}) {
    folder.write("out/tiny/seed3/result.json", bad);
    const CommandEnd report = folder.hedgehop("report out/tiny/seed3");
    EXPECT_EQ(report.status, kBadInput) << bad << report.err;
    EXPECT_THAT(report.err, HasSubstr("result.json"));
    ASSERT_EQ(folder.hedgehop("batch tiny.yaml --seeds 3 --out out --resume").status, 0) << bad;
    EXPECT_EQ(folder.json("out/tiny/seed3/result.json")["trajectory_hash"], hash) << bad;
  }
  for (const char* key : {"truth_used", "flight_time_s", "metric_units"}) {
    nlohmann::ordered_json changed = nlohmann::ordered_json::parse(whole);
    changed[key] = nullptr;
    folder.write("out/tiny/seed3/result.json", changed.dump());
    EXPECT_EQ(folder.hedgehop("bless out/tiny/seed3 --reason x --dry-run").status, kBadInput) << key;
    ASSERT_EQ(folder.hedgehop("batch tiny.yaml --seeds 3 --out out --resume").status, 0) << key;
    EXPECT_EQ(folder.json("out/tiny/seed3/result.json")["trajectory_hash"], hash) << key;
  }
  const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
  folder.write("out/tiny/seed3/result.json", whole.substr(0, whole.rfind('}')) + ", \"deep\": " + deep + "}");
  EXPECT_EQ(folder.hedgehop("report out/tiny/seed3").status, kBadInput);
  ASSERT_EQ(folder.hedgehop("batch tiny.yaml --seeds 3 --out out --resume").status, 0);
  nlohmann::ordered_json unchecked = nlohmann::ordered_json::parse(whole);
  unchecked["checks"] = nullptr;
  folder.write("out/tiny/seed3/result.json", unchecked.dump());
  ASSERT_EQ(folder.hedgehop("batch tiny.yaml --seeds 3 --out out --resume").status, 0);
  EXPECT_THAT(folder.json("out/tiny/seed3/result.json")["checks"], SizeIs(1));
}

TEST_F(BadFile, ASlurmOptionIsOneLine) {
  folder.write("sweep.yaml",
               "scenario: tiny.yaml\nseeds: 1\ntuned_on: 1:2000\ndesign: {type: grid}\n"
               "parameters: [{path: start.east, values: [0, 0.1]}]\n");
  const std::string sweep = "sweep sweep.yaml --on slurm --dry-run --out out --slurm-option=";
  EXPECT_EQ(folder.hedgehop(sweep + "--mem=1G").status, 0);
  EXPECT_EQ(folder.hedgehop(sweep + "\"$(printf -- '--mem=1\\nrm x')\"").status, kBadInput);
  EXPECT_EQ(folder.hedgehop(sweep + "mem").status, kBadInput);
}

}  // namespace
}  // namespace hedgehop::sim
