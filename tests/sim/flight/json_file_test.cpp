#include "sim/flight/json_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

class JsonFile : public testing::Test {
 protected:
  std::string fault(const std::string& text) const {
    const std::filesystem::path file = folder.path() / "a.json";
    write_file_whole(file, text);
    try {
      read_json(file);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(file.parent_path().string().size() + 1);
    }
    return "accepted";
  }
  const TemporaryFolder folder;
};

TEST_F(JsonFile, FaultsHaveLineAndColumn) {
  EXPECT_EQ(fault("{\n"), "a.json:2:1: is not complete JSON");
  EXPECT_EQ(fault(""), "a.json:1:1: is not complete JSON");
  EXPECT_EQ(fault("{\n x: 1}"), "a.json:2:2: is not valid JSON");
  EXPECT_EQ(fault("[1e999]"), "a.json: is not valid JSON: number overflow parsing '1e999'");
  EXPECT_EQ(fault("{\"a\": [1, null]}"), "accepted");
}

TEST_F(JsonFile, AMissingFileIsNamed) {
  EXPECT_THAT([&] { read_json("gone.json"); }, testing::ThrowsMessage<InputError>("gone.json: there is no such file"));
}

TEST(JsonFault, NamesTheMissingKeyOrAnotherType) {
  const Json json{{"seed", 1}};
  const auto fault = [](const auto& look_up) {
    try {
      look_up();
    } catch (const nlohmann::json::exception& error) {
      return json_fault("b.json", error, "the record of a batch");
    }
    return std::string("accepted");
  };
  EXPECT_EQ(fault([&] { json.at("groups"); }), "b.json: is not the record of a batch: the key 'groups' is missing");
  EXPECT_EQ(fault([&] { (void)json.at("seed").get<std::string>(); }),
            "b.json: is not the record of a batch: a value is of another type");
  EXPECT_EQ(fault([&] { json.at("seed").at("a"); }),
            "b.json: is not the record of a batch: a value is of another type");
}

}  // namespace
}  // namespace hedgehop::sim
