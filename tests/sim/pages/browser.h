#pragma once

#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace hedgehop::sim {

/// The result of a visit to a page in a headless browser, see browser.mjs.
struct PageVisit {
  nlohmann::json value;     ///< return value of the steps
  nlohmann::json errors;    ///< of the console, including exceptions
  nlohmann::json requests;  ///< except that for the page itself
};

/// Returns whether Debian's chromium and node are installed.
inline bool has_browser() { return std::system("command -v chromium node >/dev/null 2>&1") == 0; }

/// One browser for all visits of a test program, because its start costs more than a visit. It ends with the program.
class Browser {
 public:
  Browser() {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) throw std::runtime_error("no socket");
    std::string words[] = {"node", HEDGEHOP_SOURCE_DIR "/tests/sim/pages/browser.mjs", "chromium"};
    char* const arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO}) {
      posix_spawn_file_actions_adddup2(&actions, ends[1], stream);
    }
    const int error = posix_spawnp(&process_, "node", &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    socket_ = ends[0];
    if (error != 0) throw std::runtime_error("node does not start");
  }
  ~Browser() {
    close(socket_);
    waitpid(process_, nullptr, 0);
  }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  nlohmann::json answer(const nlohmann::json& request) {
    const std::string line = request.dump() + "\n";
    for (size_t sent = 0; sent < line.size();) {
      const ssize_t count = send(socket_, line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
      if (count <= 0) throw std::runtime_error("the browser has ended");
      sent += static_cast<size_t>(count);
    }
    std::string said;
    for (char byte = 0; read(socket_, &byte, 1) == 1 && byte != '\n';) said += byte;
    return nlohmann::json::parse(said);
  }

 private:
  int socket_ = -1;
  pid_t process_ = -1;
};

/// Opens a page from its file without network and runs `steps`, the body of an asynchronous function.
/// @param width_px, height_px  of the window.
/// Throws std::runtime_error if the browser fails.
inline PageVisit visit(const std::filesystem::path& page, const std::string& steps, int width_px = 1400,
                       int height_px = 1000) {
  static Browser browser;
  const nlohmann::json json =
      browser.answer({{"page", page.string()}, {"steps", steps}, {"width", width_px}, {"height", height_px}});
  if (json.contains("failed")) throw std::runtime_error(page.string() + ": " + json.at("failed").get<std::string>());
  return {json.at("value"), json.at("errors"), json.at("requests")};
}

}  // namespace hedgehop::sim

/// Skips a test if there is no browser.
#define HEDGEHOP_NEEDS_BROWSER() \
  if (!::hedgehop::sim::has_browser()) GTEST_SKIP() << "chromium is not installed (Debian: apt install chromium)"
