#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace hedgehop::sim::cli {

inline constexpr int kBadInput = 2;

/// The output of the program on both streams, and its exit status.
struct Answer {
  int status = -1;
  std::string text;
};
inline Answer ask(const std::string& arguments) {
  Answer answer;
  FILE* const pipe = popen((HEDGEHOP_PROGRAM " " + arguments + " 2>&1").c_str(), "r");
  if (!pipe) return answer;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) answer.text.push_back(static_cast<char>(c));
  answer.status = WEXITSTATUS(pclose(pipe));
  return answer;
}

}  // namespace hedgehop::sim::cli
