// A module as a plugin that reads one pixel of its image: a decision that takes no time of its own.
#include "avoidance/plugin.h"

namespace {

using namespace hedgehop::avoidance;

struct FirstPixelConfig {
  static constexpr std::string_view kName = "first_pixel";
  static constexpr std::string_view kMeaning = "turns by the brightness of the first pixel";
};
template <class Visitor>
void describe(Visitor&, FirstPixelConfig&) {}

class FirstPixel : public Module {
  Needs do_needs() const override { return {{{.role = "front", .channel = CameraNeed::Channel::grey}}}; }
  void do_reset(const Setup&) override {}
  Decision do_update(const Observation& seen) override {
    return {.command = VelocityCommand{.heading_rad = seen.frames[0].image.at<uint8_t>(0, 0) / 255.0}};
  }
};

std::unique_ptr<Module> make(const FirstPixelConfig&) { return std::make_unique<FirstPixel>(); }

}  // namespace

HEDGEHOP_PLUGIN(ModuleRow<FirstPixelConfig, make>)
