#include "sim/plugin/module_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

#include "sim/config/input_error.h"
#include "sim/plugin/channel.h"
#include "sim/plugin/message.h"
#include "sim/plugin/module_server.h"

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// The module's working folder. Removed at the end if it is temporary or empty.
class ModuleFolder {
 public:
  explicit ModuleFolder(const fs::path& folder) : folder_(folder), is_temporary_(folder.empty()) {
    if (is_temporary_) {
      std::string name = (fs::temp_directory_path() / "hedgehop-module-XXXXXX").string();
      if (!::mkdtemp(name.data())) fail("folder of a module");
      folder_ = name;
    }
    fs::create_directories(folder_);
    folder_ = fs::absolute(folder_);
  }
  ~ModuleFolder() {
    std::error_code ignored;
    const fs::path log = folder_ / "module.log";
    if (fs::file_size(log, ignored) == 0) fs::remove(log, ignored);
    is_temporary_ ? fs::remove_all(folder_, ignored) : static_cast<uintmax_t>(fs::remove(folder_, ignored));
  }
  ModuleFolder(const ModuleFolder&) = delete;
  ModuleFolder& operator=(const ModuleFolder&) = delete;
  const fs::path& path() const { return folder_; }

 private:
  fs::path folder_;
  bool is_temporary_;
};

/// Prepares the module's process after fork(): it keeps its two descriptors, and its output goes to its log.
void isolate(const fs::path& folder, pid_t parent, bool from_main_thread, int socket, int memory) {
  ::setsid();  // a group of its own, to be killed with all its children
  if (from_main_thread) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);
  }
  for (int signal = 1; signal < NSIG; ++signal) ::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int input = ::open("/dev/null", O_RDONLY),
            log = ::open((folder / "module.log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
  ::dup2(input, STDIN_FILENO);
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  const int kept[] = {std::min(socket, memory), std::max(socket, memory)};
  if (kept[0] > 3) ::close_range(3, static_cast<unsigned>(kept[0] - 1), 0);
  if (kept[1] > kept[0] + 1) ::close_range(static_cast<unsigned>(kept[0] + 1), static_cast<unsigned>(kept[1] - 1), 0);
  ::close_range(static_cast<unsigned>(kept[1] + 1), ~0U, 0);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (::chdir(folder.c_str()) != 0) ::_exit(1);
  // Runs before the handlers of the simulator, such as those of its renderer, which would wait for its threads.
  ::on_exit([](int status, void*) { ::_exit(status); }, nullptr);
}

size_t bytes_per_pixel(avoidance::CameraNeed::Channel channel) {
  return channel == avoidance::CameraNeed::Channel::color   ? 3
         : channel == avoidance::CameraNeed::Channel::depth ? 4
                                                            : 1;
}

/// A module in a process of its own.
class ModuleProcess : public avoidance::Module {
 public:
  ModuleProcess(const ModuleSource& source, const ModuleProcessOptions& options)
      : options_(options), folder_(options.folder) {
    start(source);
    try {
      MessageWriter request;
      request(ModuleCall::load);
      const std::string answer = call(request, options.load_limit_s, Faults::of_input);
      MessageReader in(answer);
      in.next<ModuleAnswer>();
      in(needs_, signals_);
    } catch (...) {
      stop();
      throw;
    }
  }
  ~ModuleProcess() override {
    if (broken_.empty()) {
      MessageWriter request;
      request(ModuleCall::end);
      const auto until = Channel::Clock::now() + std::chrono::duration<double>(std::min(options_.limit_s, kEndLimitS));
      std::string nothing;
      // Its end closes the channel.
      const auto deadline = std::chrono::time_point_cast<Channel::Clock::duration>(until);
      if (channel_->send(request.bytes(), deadline) == Channel::Outcome::done) channel_->receive(nothing, deadline);
    }
    stop();
    if (images_) ::munmap(images_, image_bytes_);
    if (memory_ >= 0) ::close(memory_);
  }
  ModuleProcess(const ModuleProcess&) = delete;
  ModuleProcess& operator=(const ModuleProcess&) = delete;

 private:
  static constexpr double kEndLimitS = 2.0;  // of the module's destructor
  enum class Faults { of_input, of_flight };

  avoidance::Needs do_needs() const override { return needs_; }
  std::vector<avoidance::Signal> do_signals() const override { return signals_; }

  void do_reset(const avoidance::Setup& setup) override {
    resize_images(setup);
    MessageWriter request;
    request(ModuleCall::reset, setup, image_bytes_);
    call(request, options_.load_limit_s, Faults::of_flight);
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
    return answer_of<avoidance::Decision>(request);
  }
  std::vector<avoidance::Metric> do_metrics() const override {
    return reported<std::vector<avoidance::Metric>>(ModuleCall::metrics);
  }
  avoidance::Map do_map() const override { return reported<avoidance::Map>(ModuleCall::map); }
  /// A fault of an annotation leaves the flight as it is: it is called for videos only.
  cv::Mat do_annotate() const override {
    try {
      return reported<cv::Mat>(ModuleCall::annotate);
    } catch (const std::exception&) {
      return {};
    }
  }

  template <class Answer>
  Answer answer_of(const MessageWriter& request) const {
    const std::string answer = call(request, options_.limit_s, Faults::of_flight);
    MessageReader in(answer);
    in.next<ModuleAnswer>();
    return in.next<Answer>();
  }
  /// Returns an optional report; empty once the process has ended.
  template <class Answer>
  Answer reported(ModuleCall what) const {
    if (!broken_.empty()) return {};
    MessageWriter request;
    request(what);
    return answer_of<Answer>(request);
  }

  static constexpr size_t kAlignment = 64;

  void start(const ModuleSource& source) {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) fail("socket of a module");
    memory_ = ::memfd_create("hedgehop-images", MFD_CLOEXEC);
    if (memory_ < 0) fail("shared memory of a module");
    channel_.emplace(ends[0]);
    const pid_t parent = ::getpid();
    const bool main_thread = parent == ::gettid();
    process_ = ::fork();
    if (process_ < 0) fail("process of a module");
    if (process_ == 0) {
      isolate(folder_.path(), parent, main_thread, ends[1], memory_);
      Channel channel(ends[1]);
      serve_module(source, channel, memory_);
    }
    ::close(ends[1]);
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
    if (::ftruncate(memory_, static_cast<off_t>(bytes)) != 0) fail("shared memory of a module");
    void* const mapped = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, memory_, 0);
    if (mapped == MAP_FAILED) fail("shared memory of a module");
    images_ = static_cast<char*>(mapped);
  }

  /// Sends a request and returns its answer. Throws as make_module_process() says.
  std::string call(const MessageWriter& request, double limit_s, Faults faults) const {
    if (!broken_.empty()) throw std::runtime_error(broken_);
    const auto until = Channel::Clock::now() +
                       std::chrono::duration_cast<Channel::Clock::duration>(std::chrono::duration<double>(limit_s));
    std::string answer;
    Channel::Outcome outcome = channel_->send(request.bytes(), until);
    if (outcome == Channel::Outcome::done) outcome = channel_->receive(answer, until);
    if (outcome != Channel::Outcome::done) give_up(outcome, limit_s, faults);
    try {
      throw_fault(answer, faults);
    } catch (const MalformedAnswer&) {
      give_up(Channel::Outcome::oversized, limit_s, faults);
    }
    return answer;
  }

  struct MalformedAnswer {};

  void throw_fault(const std::string& answer, Faults faults) const {
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
    if (faults == Faults::of_input) throw std::invalid_argument(line);
    throw std::runtime_error(line);
  }

  /// Ends the process and throws the cause.
  [[noreturn]] void give_up(Channel::Outcome outcome, double limit_s, Faults faults) const {
    const int status = stop();
    std::string cause = "sent an invalid answer";
    if (outcome == Channel::Outcome::overdue) {
      cause = fmt::format("did not return within {:g} s", limit_s);
    } else if (outcome == Channel::Outcome::ended && WIFEXITED(status)) {
      cause = fmt::format("ended its process (exit status {})", WEXITSTATUS(status));
    } else if (outcome == Channel::Outcome::ended) {
      cause = fmt::format("crashed ({})", ::strsignal(WTERMSIG(status)));
    }
    broken_ = fmt::format("'{}' {}", options_.name, cause);
    if (faults == Faults::of_input) throw std::invalid_argument(cause);
    throw std::runtime_error(broken_);
  }

  /// Ends the process with all its children; returns its wait status. A process that ended the channel itself gets a
  /// moment to end, so that the status is its own.
  int stop() const {
    if (process_ <= 0) return 0;
    int status = 0;
    constexpr int kMoments = 50;
    for (int moment = 0; moment < kMoments; ++moment) {
      if (::waitpid(process_, &status, WNOHANG) == process_) {
        ::kill(-process_, SIGKILL);
        process_ = 0;
        channel_->close();
        return status;
      }
      if (moment == 0 && !ended_itself()) break;
      ::usleep(2000);
    }
    ::kill(-process_, SIGKILL);
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    channel_->close();
    return status;
  }
  /// Returns whether the other end of the channel is closed.
  bool ended_itself() const {
    char byte = 0;
    return ::recv(channel_->descriptor(), &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
  }

  ModuleProcessOptions options_;
  ModuleFolder folder_;
  mutable std::optional<Channel> channel_;
  mutable pid_t process_ = 0;
  int memory_ = -1;
  char* images_ = nullptr;
  size_t image_bytes_ = 0;
  avoidance::Needs needs_;
  std::vector<avoidance::Signal> signals_;
  mutable std::string broken_;  ///< why the process ended; empty while it runs
};

}  // namespace

std::unique_ptr<avoidance::Module> make_module_process(const ModuleSource& source,
                                                       const ModuleProcessOptions& options) {
  return std::make_unique<ModuleProcess>(source, options);
}

}  // namespace hedgehop::sim
