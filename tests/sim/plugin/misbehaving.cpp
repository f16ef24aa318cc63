// A module from outside that fails in the way its parameters say.
#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "avoidance/plugin.h"

namespace {

using namespace hedgehop::avoidance;

struct MisbehavingConfig {
  static constexpr std::string_view kName = "misbehaving";
  static constexpr std::string_view kMeaning = "fails as it is told to";

  enum class How {
    behave,
    raise_exception,
    segfault,
    abort,
    recurse,
    hang,
    not_finite,
    refuse,
    exit,
    end_at_once,
    end_quickly,
    end_thread,
    throw_int,
    change_folder,
    fork,
    print,
    close_files,
    stop,
    allocate,
    change_state
  };
  enum class Where { update, make, needs, signals, reset, metrics, map, annotate, end };
  How how = How::behave;
  Where where = Where::update;
  int at = 3;
  double speed_mps = 1.0;
  std::vector<double> list = {1.0, 2.0};
  std::string word = "none", signal = "AA";
  bool flag = false;
};
template <class Visitor>
void describe(Visitor& v, MisbehavingConfig& c) {
  v("how", c.how,
    {.choices = {"behave",      "raise_exception", "segfault",  "abort",         "recurse",
                 "hang",        "not_finite",      "refuse",    "exit",          "end_at_once",
                 "end_quickly", "end_thread",      "throw_int", "change_folder", "fork",
                 "print",       "close_files",     "stop",      "allocate",      "change_state"},
     .meaning = "kind of failure"});
  v("place", c.where,
    {.choices = {"update", "make", "needs", "signals", "reset", "metrics", "map", "annotate", "end"},
     .meaning = "in which call"});
  v("at", c.at, {.at_least = 1, .meaning = "which decision"});
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "ahead"});
  v("list", c.list, {.meaning = "numbers"});
  v("word", c.word, {.meaning = "a word"});
  v("signal", c.signal, {.meaning = "name of a signal"});
  v("flag", c.flag, {.meaning = "a flag"});
}

/// Has no end but the stack's.
int recurse(int depth) {
  volatile int mark = depth;
  return mark < 0 ? 0 : recurse(mark + 1) + mark;
}

class Misbehaving : public Module {
 public:
  explicit Misbehaving(const MisbehavingConfig& config) : config_(config) {
    if (config.how == MisbehavingConfig::How::refuse) throw std::invalid_argument("how: not today");
    misbehave_in(MisbehavingConfig::Where::make);
  }
  ~Misbehaving() override { misbehave_in(MisbehavingConfig::Where::end); }

 private:
  Needs do_needs() const override {
    misbehave_in(MisbehavingConfig::Where::needs);
    return {{{.role = "front"}}};
  }
  std::vector<Signal> do_signals() const override {
    misbehave_in(MisbehavingConfig::Where::signals);
    return {{config_.signal, "m"}, {"aa", "m"}};  // a column each
  }
  void do_reset(const Setup&) override {
    misbehave_in(MisbehavingConfig::Where::reset);
    decisions_ = 0;
  }
  Map do_map() const override {
    misbehave_in(MisbehavingConfig::Where::map);
    return {};
  }
  cv::Mat do_annotate() const override {
    misbehave_in(MisbehavingConfig::Where::annotate);
    return {};
  }

  Decision do_update(const Observation& seen) override {
    if (++decisions_ == config_.at) misbehave_in(MisbehavingConfig::Where::update);
    VelocityCommand command{.v_WB_W = {speed_factor_ * config_.speed_mps, 0.0}, .altitude_m = -seen.goal.p_WG.z()};
    if (decisions_ >= config_.at && config_.how == MisbehavingConfig::How::not_finite) {
      command.altitude_m = std::numeric_limits<double>::quiet_NaN();
    }
    return {.command = command, .status = "cruise", .signals = {1.0, 2.0}};
  }

  void misbehave_in(MisbehavingConfig::Where where) const {
    using How = MisbehavingConfig::How;
    if (config_.where != where) return;
    if (config_.how == How::exit) std::exit(0);
    if (config_.how == How::end_at_once) ::_exit(0);
    if (config_.how == How::end_quickly) std::quick_exit(0);
    if (config_.how == How::end_thread) ::pthread_exit(nullptr);
    if (config_.how == How::throw_int) throw 42;
    if (config_.how == How::change_folder && ::chdir("/") != 0) std::abort();
    if (config_.how == How::fork && ::fork() < 0) std::abort();
    if (config_.how == How::print) std::puts("text of the module");
    if (config_.how == How::close_files) ::closefrom(0);
    if (config_.how == How::change_state) speed_factor_ = 0.0;
    while (config_.how == How::allocate) {
      spins_ = spins_ + 97;
      void* volatile block = std::malloc(1 + spins_ % 100'000);
      std::free(block);
    }
    if (config_.how == How::stop) std::raise(SIGSTOP);
    if (config_.how == How::raise_exception) throw std::runtime_error("no idea");
    if (config_.how == How::segfault) *static_cast<volatile int*>(nullptr) = 1;
    if (config_.how == How::abort) std::abort();
    if (config_.how == How::recurse) spins_ = spins_ + static_cast<unsigned>(recurse(1));
    while (config_.how == How::hang) spins_ = spins_ + 1;
  }

  std::vector<Metric> do_metrics() const override {
    misbehave_in(MisbehavingConfig::Where::metrics);
    double sum = config_.flag ? 100.0 : 0.0;
    for (const double number : config_.list) sum += number;
    return {{"decisions_seen", static_cast<double>(decisions_), ""},
            {"parameters_sum", sum + static_cast<double>(config_.word.size()), ""},
            {"AA", 1.0, ""},
            {"aa", 2.0, ""},              // a database takes both for one
            {"corners_found", 1.0, ""}};  // the name of a figure of the judge
  }

  MisbehavingConfig config_;
  int decisions_ = 0;
  mutable volatile unsigned spins_ = 0;
  mutable double speed_factor_ = 1.0;
};

std::unique_ptr<Module> make(const MisbehavingConfig& config) { return std::make_unique<Misbehaving>(config); }

}  // namespace

HEDGEHOP_PLUGIN(ModuleRow<MisbehavingConfig, make>)
