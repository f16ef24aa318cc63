#include "sim/plugin/module_server.h"

#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/config/input_error.h"
#include "sim/fields/shortened.h"
#include "sim/plugin/message.h"

namespace hedgehop::sim {
namespace {

std::string text_of(const std::exception& error) {
  constexpr size_t kMaxBytes = 2000;
  return one_line(shortened(error.what(), kMaxBytes));
}

class ModuleServer {
 public:
  ModuleServer(const ModuleSource& source, Channel& channel, int memory)
      : source_(source), channel_(channel), memory_(memory), process_(::getpid()) {}

  void run() {
    std::string request;
    while (channel_.receive(request) == Channel::Outcome::done) {
      MessageReader in(request);
      const auto call = in.next<ModuleCall>();
      if (call == ModuleCall::end) break;
      if (call == ModuleCall::annotate) {
        annotate_in_copy(in.next<double>());
      } else {
        answer(channel_, [&](MessageWriter& out) { perform(call, in, out); });
      }
    }
    module_.reset();
  }

 private:
  void perform(ModuleCall call, MessageReader& in, MessageWriter& out) {
    switch (call) {
      case ModuleCall::load:
        module_ = source_();
        return out(module_->needs(), module_->signals());
      case ModuleCall::reset: {
        const auto setup = in.next<avoidance::Setup>();
        map_images(in.next<size_t>());
        return module_->reset(setup);
      }
      case ModuleCall::update:
        return out(module_->update(observation(in)));
      case ModuleCall::metrics:
        return out(module_->metrics());
      case ModuleCall::map:
        return out(module_->map());
      case ModuleCall::annotate:
      case ModuleCall::end:
        return;
    }
  }

  /// Lets a copy of this process draw the image, so that the flight does not depend on it. A copy that does not answer
  /// within the limit is killed.
  void annotate_in_copy(double limit_s) {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return send_fault("has no socket left");
    Channel own(ends[0]), other(ends[1]);
    const pid_t copy = ::fork();
    if (copy == 0) {
      process_ = ::getpid();
      own.close();
      answer(other, [&](MessageWriter& out) { out(module_->annotate()); });
      ::_exit(0);
    }
    other.close();
    std::string drawn;
    const auto limit = std::chrono::duration_cast<Channel::Clock::duration>(std::chrono::duration<double>(limit_s));
    const bool has_drawn = copy > 0 && own.receive(drawn, Channel::Clock::now() + limit) == Channel::Outcome::done;
    if (copy > 0) {
      ::kill(copy, SIGKILL);
      ::waitpid(copy, nullptr, 0);
    }
    if (!has_drawn) return send_fault("did not draw its image");
    channel_.send(drawn);
  }

  void send_fault(const char* what) {
    MessageWriter fault;
    fault(ModuleAnswer::fault, std::vector<std::string>{what}, size_t{0});
    channel_.send(fault.bytes());
  }

  /// Sends the result of a call, or its fault. A copy of the process that the module made by fork() ends here.
  void answer(Channel& channel, const std::function<void(MessageWriter&)>& call) {
    MessageWriter done, failed;
    bool holds = true;
    const auto fail = [&](ModuleAnswer kind, std::vector<std::string> lines, const std::vector<FieldError>& fields) {
      holds = false;
      failed(kind, std::move(lines), fields.size());
      for (const FieldError& field : fields) failed(field.path, field.message);
    };
    const std::vector<FieldError> none;
    done(ModuleAnswer::done);
    try {
      call(done);
    } catch (const InputError& error) {
      fail(ModuleAnswer::input_error, error.errors(), error.field_errors());
    } catch (const std::logic_error& error) {
      fail(ModuleAnswer::refused, {text_of(error)}, none);
    } catch (const std::exception& error) {
      fail(ModuleAnswer::failed, {text_of(error)}, none);
    } catch (...) {
      fail(ModuleAnswer::fault, {"threw an object that is no std::exception"}, none);
    }
    if (::getpid() != process_) ::_exit(0);
    const Channel::Outcome sent = channel.send(holds ? done.bytes() : failed.bytes());
    if (sent != Channel::Outcome::oversized) return;
    MessageWriter large;
    large(ModuleAnswer::failed, std::vector<std::string>{"gave an answer of more than 256 MB"}, size_t{0});
    channel.send(large.bytes());
  }

  void map_images(size_t bytes) {
    if (images_) ::munmap(images_, image_bytes_);
    images_ = nullptr;
    image_bytes_ = bytes;
    if (bytes == 0) return;
    void* const mapped = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, memory_, 0);
    if (mapped == MAP_FAILED) throw std::runtime_error("cannot map the shared memory of the images");
    images_ = static_cast<char*>(mapped);
  }

  avoidance::Observation observation(MessageReader& in) {
    avoidance::Observation seen;
    in(seen.t_ns, seen.navigation, seen.goal);
    frames_.resize(in.next<size_t>());
    for (avoidance::CameraFrame& frame : frames_) {
      in(frame.role, frame.t_ns);
      const auto image = in.next<SharedImage>();
      if (image.is_inside) {
        in(frame.image);
      } else {
        frame.image = cv::Mat(image.rows, image.cols, image.type, images_ + image.offset);
      }
    }
    seen.frames = frames_;
    return seen;
  }

  const ModuleSource& source_;
  Channel& channel_;
  int memory_;
  pid_t process_;
  std::unique_ptr<avoidance::Module> module_;
  char* images_ = nullptr;
  size_t image_bytes_ = 0;
  std::vector<avoidance::CameraFrame> frames_;
};

}  // namespace

void serve_module(const ModuleSource& source, Channel& channel, int memory) {
  { ModuleServer(source, channel, memory).run(); }
  std::fflush(nullptr);
  std::cout.flush();
  ::_exit(0);
}

}  // namespace hedgehop::sim
