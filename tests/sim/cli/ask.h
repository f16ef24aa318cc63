#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <string>

#include "tests/sim/cli/exit_status.h"

namespace hedgehop::sim::cli {

/// The output of the program on both streams, and its exit status.
struct Answer {
  int status = -1;  ///< 128 and the signal's number if a signal ended it
  std::string text;
};
inline Answer ask(const std::string& arguments) {
  Answer answer;
  FILE* const pipe = popen((HEDGEHOP_PROGRAM " " + arguments + " 2>&1").c_str(), "r");
  if (!pipe) return answer;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) answer.text.push_back(static_cast<char>(c));
  const int status = pclose(pipe);
  answer.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return answer;
}

}  // namespace hedgehop::sim::cli
