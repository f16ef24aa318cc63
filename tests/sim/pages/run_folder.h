#pragma once

#include <string>
#include <vector>

#include "sim/record/result_files.h"
#include "sim/scenario/scenario.h"
#include "tests/sim/record/fake_flight.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {

/// A folder with the results of a synthetic flight of ten seconds.
class RunFolder : public TemporaryFolder {
 public:
  RunFolder() {
    write_result_files(path(), {.scenario = "city </script>", .seed = 9, .scenario_yaml = yaml()},
                       fake_flight(10.0, 1));
  }
  std::string yaml() const {
    const std::vector<std::string> overrides = {"drawing.renderer=tiles"};
    return to_yaml(load_scenario(HEDGEHOP_SOURCE_DIR "/configs/garratt2009_city_0_light.yaml", overrides));
  }
};

}  // namespace hedgehop::sim
