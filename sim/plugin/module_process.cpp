#include "sim/plugin/module_process.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <utility>

#include "sim/config/input_error.h"
#include "sim/plugin/channel.h"
#include "sim/plugin/isolated_process.h"
#include "sim/plugin/message.h"
#include "sim/plugin/module_server.h"

namespace hedgehop::sim {
namespace {

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

size_t bytes_per_pixel(avoidance::CameraNeed::Channel channel) {
  return channel == avoidance::CameraNeed::Channel::color   ? 3
         : channel == avoidance::CameraNeed::Channel::depth ? 4
                                                            : 1;
}

/// A module in a process of its own.
class ModuleProcess : public avoidance::Module {
 public:
  ModuleProcess(const ModuleSource& source, const ModuleProcessOptions& options)
      : options_(options),
        process_(options.folder, [&](Channel& channel, int memory) { serve_module(source, channel, memory); }) {
    MessageWriter request;
    request(ModuleCall::load);
    const std::string answer = load(request);
    MessageReader in(answer);
    in.next<ModuleAnswer>();
    in(needs_, signals_);
  }
  ~ModuleProcess() override {
    if (broken_.empty()) {
      MessageWriter request;
      request(ModuleCall::end);
      const auto until = after(std::min(options_.limit_s, kEndLimitS));
      std::string nothing;  // its end closes the channel
      if (process_.channel().send(request.bytes(), until) == Channel::Outcome::done) {
        process_.channel().receive(nothing, until);
      }
    }
    process_.stop();
    if (images_) ::munmap(images_, image_bytes_);
  }
  ModuleProcess(const ModuleProcess&) = delete;
  ModuleProcess& operator=(const ModuleProcess&) = delete;

 private:
  static constexpr double kEndLimitS = 2.0;  // of the module's destructor

  avoidance::Needs do_needs() const override { return needs_; }
  std::vector<avoidance::Signal> do_signals() const override { return signals_; }

  void do_reset(const avoidance::Setup& setup) override {
    resize_images(setup);
    MessageWriter request;
    request(ModuleCall::reset, setup, image_bytes_);
    try {
      call(request, options_.load_limit_s);
    } catch (const InputError&) {
      throw;
    } catch (const ModuleFault& fault) {
      broken_ = fmt::format("{} while it was reset", fault.what());
    } catch (const std::runtime_error& failure) {
      broken_ = fmt::format("'{}' failed while it was reset: {}", options_.name, failure.what());
    }
  }

  avoidance::Decision do_update(const avoidance::Observation& seen) override {
    MessageWriter request;
    request(ModuleCall::update, seen.t_ns, seen.navigation, seen.goal, seen.frames.size());
    size_t used = 0;
    for (const avoidance::CameraFrame& frame : seen.frames) {
      const cv::Mat& image = frame.image;
      const size_t bytes = image.total() * image.elemSize();
      SharedImage shared{.rows = image.rows, .cols = image.cols, .type = image.type(), .offset = used};
      shared.is_inside = bytes > image_bytes_ - used;
      request(frame.role, frame.t_ns, shared);
      if (shared.is_inside) {
        request(image);
      } else {
        image.copyTo(cv::Mat(image.rows, image.cols, image.type(), images_ + used));
        used += (bytes + kAlignment - 1) / kAlignment * kAlignment;
      }
    }
    return answer_of<avoidance::Decision>(request, options_.limit_s);
  }
  std::vector<avoidance::Metric> do_metrics() const override {
    return reported<std::vector<avoidance::Metric>>(ModuleCall::metrics);
  }
  avoidance::Map do_map() const override { return reported<avoidance::Map>(ModuleCall::map); }
  /// After its first crash or timeout, no more images are requested.
  cv::Mat do_annotate() const override {
    if (!draws_) return {};
    MessageWriter request;
    request(ModuleCall::annotate, options_.limit_s);
    try {
      return answer_of<cv::Mat>(request, options_.limit_s + kEndLimitS);
    } catch (const ModuleFault&) {
      draws_ = false;
    } catch (const std::exception&) {  // perhaps of this image only
    }
    return {};
  }

  template <class Answer>
  Answer answer_of(const MessageWriter& request, double limit_s) const {
    const std::string answer = call(request, limit_s);
    MessageReader in(answer);
    in.next<ModuleAnswer>();
    return in.next<Answer>();
  }
  template <class Answer>
  Answer reported(ModuleCall what) const {
    MessageWriter request;
    request(what);
    return answer_of<Answer>(request, options_.limit_s);
  }

  static constexpr size_t kAlignment = 64;

  static Channel::Clock::time_point after(double seconds) {
    return Channel::Clock::now() +
           std::chrono::duration_cast<Channel::Clock::duration>(std::chrono::duration<double>(seconds));
  }

  /// Makes the shared memory large enough for one image of each needed camera.
  void resize_images(const avoidance::Setup& setup) {
    size_t bytes = 0;
    for (const avoidance::CameraNeed& need : needs_.cameras) {
      for (const avoidance::MountedCamera& camera : setup.cameras) {
        if (camera.role != need.role) continue;
        bytes += static_cast<size_t>(camera.model.width_px) * static_cast<size_t>(camera.model.height_px) *
                     bytes_per_pixel(need.channel) +
                 kAlignment;
      }
    }
    if (images_) ::munmap(images_, image_bytes_);
    images_ = nullptr;
    image_bytes_ = bytes;
    if (bytes == 0) return;
    if (::ftruncate(process_.memory(), static_cast<off_t>(bytes)) != 0) fail("shared memory of a module");
    void* const mapped = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, process_.memory(), 0);
    if (mapped == MAP_FAILED) fail("shared memory of a module");
    images_ = static_cast<char*>(mapped);
  }

  /// Sends the first request and returns its answer. Throws as make_module_process() says.
  std::string load(const MessageWriter& request) const {
    try {
      return call(request, options_.load_limit_s);
    } catch (const InputError&) {
      throw;
    } catch (const ModuleFault& fault) {
      throw ModuleFault(fmt::format("{} while it was loaded", fault.what()));
    } catch (const std::runtime_error& failure) {
      throw ModuleFault(fmt::format("'{}' failed while it was loaded: {}", options_.name, failure.what()));
    }
  }

  /// Sends a request and returns its answer. Throws ModuleFault, InputError, or, with the text of another exception of
  /// the module, std::invalid_argument for a std::logic_error and std::runtime_error otherwise.
  std::string call(const MessageWriter& request, double limit_s) const {
    if (!broken_.empty()) throw ModuleFault(broken_);
    const auto until = after(limit_s);
    std::string answer;
    Channel::Outcome outcome = process_.channel().send(request.bytes(), until);
    if (outcome == Channel::Outcome::done) outcome = process_.channel().receive(answer, until);
    if (outcome != Channel::Outcome::done) give_up(outcome, limit_s);
    try {
      throw_fault(answer);
    } catch (const MalformedAnswer&) {
      give_up(Channel::Outcome::oversized, limit_s);
    }
    return answer;
  }

  struct MalformedAnswer {};

  void throw_fault(const std::string& answer) const {
    MessageReader in(answer);
    ModuleAnswer kind{};
    std::vector<std::string> lines;
    std::vector<FieldError> fields;
    try {
      in(kind);
      if (kind == ModuleAnswer::done) return;
      in(lines);
      fields.resize(std::min<size_t>(in.next<size_t>(), answer.size()));
      for (FieldError& field : fields) in(field.path, field.message);
    } catch (const std::runtime_error&) {
      throw MalformedAnswer();
    }
    if (kind == ModuleAnswer::input_error && fields.empty()) throw InputError(lines);
    if (kind == ModuleAnswer::input_error) throw InputError(std::move(fields));
    const std::string line = lines.empty() || lines[0].empty() ? "threw an exception without a text" : lines[0];
    if (kind == ModuleAnswer::refused) throw std::invalid_argument(line);
    if (kind == ModuleAnswer::fault) throw ModuleFault(fmt::format("'{}' {}", options_.name, line));
    throw std::runtime_error(line);
  }

  /// Ends the process and throws the cause.
  [[noreturn]] void give_up(Channel::Outcome outcome, double limit_s) const {
    const int status = process_.stop();
    std::string cause = "sent an invalid answer";
    if (outcome == Channel::Outcome::overdue) {
      cause = fmt::format("did not return within {:g} s", limit_s);
    } else if (outcome == Channel::Outcome::ended && WIFEXITED(status)) {
      cause = fmt::format("ended its process (exit status {})", WEXITSTATUS(status));
    } else if (outcome == Channel::Outcome::ended) {
      cause = fmt::format("crashed ({})", ::strsignal(WTERMSIG(status)));
    }
    broken_ = fmt::format("'{}' {}", options_.name, cause);
    throw ModuleFault(broken_);
  }

  ModuleProcessOptions options_;
  mutable IsolatedProcess process_;
  char* images_ = nullptr;
  size_t image_bytes_ = 0;
  avoidance::Needs needs_;
  std::vector<avoidance::Signal> signals_;
  mutable std::string broken_;  ///< why the module no longer answers; empty while it does
  mutable bool draws_ = true;
};

}  // namespace

std::unique_ptr<avoidance::Module> make_module_process(const ModuleSource& source,
                                                       const ModuleProcessOptions& options) {
  return std::make_unique<ModuleProcess>(source, options);
}

}  // namespace hedgehop::sim
