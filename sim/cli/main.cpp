#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <initializer_list>

#include "sim/cli/command_line.h"
#include "sim/cli/exit_status.h"

namespace {

/// A file opened while one of the standard streams is closed would get its number, and its text.
void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", O_RDWR);  // takes the lowest number that is free
  }
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  std::signal(SIGPIPE, SIG_IGN);  // a reader that has seen enough ends no flight
  std::signal(SIGXFSZ, SIG_IGN);  // a file past its limit (ulimit -f) is an error of writing
  constexpr size_t kBufferBytes = 1 << 20;
  std::setvbuf(stdout, nullptr, _IOFBF, kBufferBytes);  // so that a result is written whole, or known not to be
  const int status = hedgehop::sim::cli::run_command_line(argc, argv);
  if (std::fflush(stdout) != 0 && errno != EPIPE) {
    std::fprintf(stderr, "hedgehop: cannot write to standard output: %s\n", std::strerror(errno));
    return hedgehop::sim::cli::kInternalError;
  }
  return status;
}
