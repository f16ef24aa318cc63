#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "sim/config/include.h"
#include "sim/config/input_error.h"
#include "sim/config/reader.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {

/// A folder for one test, made the working folder until it goes, so that messages name short paths.
class Folder : public TemporaryFolder {
 public:
  Folder() : before_(std::filesystem::current_path()) { std::filesystem::current_path(path()); }
  ~Folder() { std::filesystem::current_path(before_); }

  static void write(const std::filesystem::path& file, const std::string& text) {
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
  }

 private:
  std::filesystem::path before_;
};

/// Returns the errors that `f` throws as InputError; empty without an exception.
template <class F>
std::vector<std::string> faults_of(F&& f) {
  try {
    f();
  } catch (const InputError& error) {
    return error.errors();
  }
  return {};
}

/// Reads a struct as load_scenario() reads a scenario: file `file`, then overrides.
template <class T>
T load_struct(const std::filesystem::path& file, const std::vector<std::string>& overrides = {}) {
  ErrorList faults("scenario");
  Node root = load_tree(file, faults);
  if (root.kind != Node::Kind::map) faults.throw_if_any();
  std::set<std::filesystem::path> read;
  apply_overrides(root, overrides, file, faults, read);
  T value;
  read_struct(root, "", "", value, faults);
  faults.throw_if_any();
  return value;
}

inline const std::filesystem::path kConfigs = std::filesystem::path(HEDGEHOP_SOURCE_DIR) / "configs";

/// The scenarios of folders below configs/, in order of name.
inline std::vector<std::filesystem::path> scenarios_in(std::initializer_list<const char*> folders) {
  std::vector<std::filesystem::path> files;
  for (const char* folder : folders) {
    for (const auto& entry : std::filesystem::directory_iterator((kConfigs / folder).lexically_normal())) {
      if (entry.path().extension() == ".yaml") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Every scenario that ships with the project. Worlds and modules of the leaderboard are parts, which the tests of its
/// campaigns join.
inline std::vector<std::filesystem::path> shipped_scenarios() { return scenarios_in({".", "links", "worlds"}); }

}  // namespace hedgehop::sim
