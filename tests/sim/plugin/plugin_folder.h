#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim {

/// A folder whose scenario is flown by a module from outside.
class Plugin : public ::testing::Test {
 protected:
  void fly_by(const std::string& library, const std::string& more) const {
    folder.write("plug.yaml", "use: tiny.yaml\nname: plug\nduration: 0.4\navoidance: {plugin: " + library +
                                  ", module: misbehaving, " + more + "}\n");
  }
  CommandEnd run(const std::string& parameters, const std::string& arguments = "") const {
    fly_by(HEDGEHOP_MISBEHAVING, "limit: 1, parameters: {" + parameters + "}");
    return folder.hedgehop("run plug.yaml --no-video --no-report --out out " + arguments);
  }
  CampaignFolder folder;
};

}  // namespace hedgehop::sim
