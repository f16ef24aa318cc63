// Renders images of any camera at any time while the scenario's module flies.
//   photographer SCENARIO.yaml CAMERA PERIOD_S [KEY.PATH=VALUE]...
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "sim/simulation/simulation.h"

using namespace hedgehop;

namespace {

void photograph(const std::string& file, const std::string& camera, double period_s,
                const std::vector<std::string>& overrides) {
  sim::Simulation simulation(sim::load_flight(file, overrides));
  for (int number = 0; !simulation.over(); ++number) {
    const std::string name = "photo" + std::to_string(number) + ".png";
    cv::imwrite(name, simulation.image(camera, sim::ImageChannel::grey));
    std::printf("%s at %.2f s, %.2f m up\n", name.c_str(), simulation.t_s(), -simulation.truth().p_WB.z());
    const double until_s = simulation.t_s() + period_s;
    while (!simulation.over() && simulation.t_s() < until_s) simulation.tick();
  }
}

}  // namespace

int main(int count, char** words) {
  if (count < 4 || std::atof(words[3]) <= 0.0) {
    std::fprintf(stderr, "usage: photographer SCENARIO.yaml CAMERA PERIOD_S [KEY.PATH=VALUE]...\n");
    return 2;
  }
  try {
    photograph(words[1], words[2], std::atof(words[3]), {words + 4, words + count});
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 2;
  }
}
