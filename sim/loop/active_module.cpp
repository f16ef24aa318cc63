#include "sim/loop/active_module.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "sim/plugin/foreign_module.h"
#include "sim/plugin/module_fault.h"

namespace hedgehop::sim {
namespace {

bool same_cameras(const avoidance::Needs& a, const avoidance::Needs& b) {
  return std::ranges::equal(a.cameras, b.cameras, [](const avoidance::CameraNeed& x, const avoidance::CameraNeed& y) {
    return x.role == y.role && x.channel == y.channel && x.pinhole == y.pinhole;
  });
}

/// Returns the needs of both modules; the types of command are not declared if one of the two does not declare its own.
avoidance::Needs needs_of_both(const avoidance::Needs& a, const avoidance::Needs& b) {
  avoidance::Needs both = a;
  if (b.commands.empty()) both.commands.clear();
  if (!both.commands.empty()) both.commands.insert(both.commands.end(), b.commands.begin(), b.commands.end());
  return both;
}

class Takeover : public avoidance::Module {
 public:
  Takeover(std::unique_ptr<Module> before, std::unique_ptr<Module> after, int64_t at_ns)
      : before_(std::move(before)), after_(std::move(after)), at_ns_(at_ns), signals_(before_->signals()) {
    if (!same_cameras(before_->needs(), after_->needs())) {
      throw std::invalid_argument("needs other cameras than the module that it replaces");
    }
    for (const avoidance::Signal& signal : after_->signals()) {
      auto known = std::ranges::find(signals_, signal.name, &avoidance::Signal::name);
      if (known == signals_.end()) known = signals_.insert(known, signal);
      indices_of_after_.push_back(static_cast<size_t>(known - signals_.begin()));
    }
  }

 private:
  avoidance::Needs do_needs() const override { return needs_of_both(before_->needs(), after_->needs()); }
  std::vector<avoidance::Signal> do_signals() const override { return signals_; }
  void do_reset(const avoidance::Setup& setup) override {
    has_taken_over_ = false;
    before_->reset(setup);
    after_->reset(setup);
  }

  avoidance::Decision do_update(const avoidance::Observation& observation) override {
    has_taken_over_ = observation.t_ns >= at_ns_;
    avoidance::Decision of_after = after_->update(observation);
    std::vector<double> signals(signals_.size(), std::numeric_limits<double>::quiet_NaN());
    if (!has_taken_over_) {
      avoidance::Decision decision = before_->update(observation);
      std::ranges::copy(decision.signals, signals.begin());
      decision.signals = std::move(signals);
      return decision;
    }
    for (size_t i = 0; i < indices_of_after_.size(); ++i) signals[indices_of_after_[i]] = of_after.signals[i];
    of_after.signals = std::move(signals);
    return of_after;
  }

  std::vector<avoidance::Metric> do_metrics() const override { return active().metrics(); }
  avoidance::Map do_map() const override { return active().map(); }
  cv::Mat do_annotate() const override { return active().annotate(); }

  const Module& active() const { return has_taken_over_ ? *after_ : *before_; }

  std::unique_ptr<Module> before_, after_;
  int64_t at_ns_;
  bool has_taken_over_ = false;
  std::vector<avoidance::Signal> signals_;  ///< of before_, then those that only after_ has
  std::vector<size_t> indices_of_after_;
};

/// A module that failed while it was made. It fails again in the flight, so that the flight has a verdict.
class FailedModule : public avoidance::Module {
 public:
  explicit FailedModule(ModuleFault fault) : fault_(std::move(fault)) {}

 private:
  avoidance::Needs do_needs() const override { return {}; }
  void do_reset(const avoidance::Setup&) override {}
  avoidance::Decision do_update(const avoidance::Observation&) override { throw fault_; }
  std::vector<avoidance::Metric> do_metrics() const override { throw fault_; }
  ModuleFault fault_;
};

/// Makes the module of a takeover. The errors of make_module() name the scenario's own module.
std::unique_ptr<avoidance::Module> make_successor(const AvoidanceConfig& config, const std::filesystem::path& folder) {
  try {
    return make_module(config, folder);
  } catch (const InputError& error) {
    std::vector<FieldError> errors = error.field_errors();
    if (errors.empty()) throw;
    for (FieldError& each : errors) each.path = join_path("takeover", each.path);
    throw InputError(std::move(errors));
  }
}

}  // namespace

std::unique_ptr<avoidance::Module> make_active_module(const Scenario& scenario, const Ticks& ticks,
                                                      std::unique_ptr<avoidance::Module> module,
                                                      const std::filesystem::path& folder) try {
  if (!module) module = make_module(scenario.avoidance, folder);
  if (!scenario.takeover) return module;
  return build_part("takeover.avoidance", [&] {
    return make_takeover(std::move(module),
                         make_successor(scenario.takeover->avoidance, folder.empty() ? folder : folder / "takeover"),
                         ticks.t_ns(ticks.ticks(scenario.takeover->at_s)));
  });
} catch (const ModuleFault& fault) {
  return std::make_unique<FailedModule>(fault);
}

std::unique_ptr<avoidance::Module> make_takeover(std::unique_ptr<avoidance::Module> before,
                                                 std::unique_ptr<avoidance::Module> after, int64_t at_ns) {
  return std::make_unique<Takeover>(std::move(before), std::move(after), at_ns);
}

}  // namespace hedgehop::sim
