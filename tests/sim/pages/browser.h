#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/config/whole_file.h"

namespace hedgehop::sim {

/// The result of a visit to a page in a headless browser, see browser.mjs.
struct PageVisit {
  nlohmann::json value;     ///< return value of the steps
  nlohmann::json errors;    ///< of the console, including exceptions
  nlohmann::json requests;  ///< except that for the page itself
};

/// Returns whether Debian's chromium and node are installed.
inline bool has_browser() { return std::system("command -v chromium node >/dev/null 2>&1") == 0; }

/// Opens a page from its file without network and runs `steps`, the body of an asynchronous function.
/// Throws std::runtime_error if the browser fails.
inline PageVisit visit(const std::filesystem::path& page, const std::string& steps) {
  const std::filesystem::path script = page.string() + ".steps.js", answer = page.string() + ".answer.json";
  write_file_whole(script, steps);
  const std::string command = "node '" HEDGEHOP_SOURCE_DIR "/tests/sim/pages/browser.mjs' chromium '" + page.string() +
                              "' '" + script.string() + "' > '" + answer.string() + "'";
  if (std::system(command.c_str()) != 0) throw std::runtime_error("the browser failed on " + page.string());
  const nlohmann::json json = nlohmann::json::parse(read_file_whole(answer));
  return {json.at("value"), json.at("errors"), json.at("requests")};
}

}  // namespace hedgehop::sim

/// Skips a test if there is no browser.
#define HEDGEHOP_NEEDS_BROWSER() \
  if (!::hedgehop::sim::has_browser()) GTEST_SKIP() << "chromium is not installed (Debian: apt install chromium)"
