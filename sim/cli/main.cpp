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

/// Writes a part of the results. Whoever prints them need not care that a pipe's reader has seen enough, nor that a
/// disk is full: what cannot be written is dropped. @param error  errno of the first fault, an int.
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
  std::signal(SIGPIPE, SIG_IGN);  // a reader that has seen enough ends no flight
  std::signal(SIGXFSZ, SIG_IGN);  // a file past its limit (ulimit -f) is an error of writing
  int error = 0;
  if (FILE* const results = ::fopencookie(&error, "w", {nullptr, write_results, nullptr, nullptr})) stdout = results;
  const int status = hedgehop::sim::cli::run_command_line(argc, argv);
  std::fflush(stdout);
  if (error == 0 || error == EPIPE) return status;
  std::fprintf(stderr, "hedgehop: cannot write to standard output: %s\n", std::strerror(error));
  return hedgehop::sim::cli::kInternalError;
}
