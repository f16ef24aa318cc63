#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <initializer_list>

#include "sim/cli/commands.h"
#include "sim/cli/exit_status.h"

namespace {

/// Opens closed standard streams; otherwise the next opened file would get the descriptor and the text of the stream.
void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", O_RDWR);  // open() returns the lowest free descriptor
  }
}

/// Raises the stack limit of this process if it is too small. Returns whether it is sufficient.
bool require_stack() {
  constexpr rlim_t kRequiredBytes = 2 << 20;
  rlimit stack{};
  if (::getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= kRequiredBytes) return true;
  if (stack.rlim_max >= kRequiredBytes) {
    stack.rlim_cur = kRequiredBytes;
    if (::setrlimit(RLIMIT_STACK, &stack) == 0) return true;
  }
  std::fprintf(stderr, "hedgehop: the stack limit is %llu kB; at least %llu kB are required (ulimit -s)\n",
               static_cast<unsigned long long>(stack.rlim_cur >> 10),
               static_cast<unsigned long long>(kRequiredBytes >> 10));
  return false;
}

/// Writes a part of the results to standard output. After a write error (a closed pipe, a full disk) it drops the text,
/// so that callers need not handle errors. @param error  int that stores the errno of the first error.
ssize_t write_results(void* error, const char* text, size_t bytes) {
  int& first_fault = *static_cast<int*>(error);
  for (size_t written = 0; first_fault == 0 && written < bytes;) {
    const ssize_t count = ::write(STDOUT_FILENO, text + written, bytes - written);
    if (count >= 0) {
      written += static_cast<size_t>(count);
    } else if (errno != EINTR) {
      first_fault = errno;
    }
  }
  return static_cast<ssize_t>(bytes);
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  if (!require_stack()) return hedgehop::sim::cli::kBadInput;
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe must not end a flight
  std::signal(SIGXFSZ, SIG_IGN);  // exceeding the file size limit (ulimit -f) is a write error
  int error = 0;
  if (FILE* const results = ::fopencookie(&error, "w", {nullptr, write_results, nullptr, nullptr})) stdout = results;
  const int status = hedgehop::sim::cli::run_command_line(argc, argv);
  std::fflush(stdout);
  if (error == 0 || error == EPIPE) return status;
  std::fprintf(stderr, "hedgehop: cannot write to standard output: %s\n", std::strerror(error));
  return hedgehop::sim::cli::kInternalError;
}
