#include "sim/batch/input_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "sim/config/config_tree.h"
#include "sim/config/include.h"
#include "sim/flight/words.h"
#include "sim/scenario/file_kind.h"

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;

bool is_yaml(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".yaml" || ending == ".yml";
}

bool is_hidden(const fs::path& file) { return file.filename().string().starts_with('.'); }

/// Whether a flight has written this scenario.
bool is_result(const fs::path& file) {
  std::error_code error;
  return file.filename() == "scenario.yaml" && fs::exists(file.parent_path() / "result.json", error);
}

size_t count_yaml(const fs::path& folder) {
  std::error_code error;
  size_t count = 0;
  const auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator entry(folder, options, error), end; entry != end; entry.increment(error)) {
    if (is_hidden(entry->path())) {
      entry.disable_recursion_pending();
    } else if (!entry->is_directory(error) && is_yaml(entry->path()) && !is_result(entry->path())) {
      ++count;
    }
  }
  return count;
}

void add_files(const fs::path& folder, bool recursive, FolderFiles& files);

/// Descends into a subfolder or counts its files. A link to a folder may lead back to this one, so it is not followed.
void add_subfolder(const fs::directory_entry& entry, bool recursive, FolderFiles& files) {
  std::error_code error;
  const bool is_link = entry.is_symlink(error);
  if (recursive && !is_link) {
    add_files(entry.path(), true, files);
  } else if (const size_t count = count_yaml(entry.path()); count > 0) {
    if (is_link) {
      files.links.push_back(entry.path());
    } else {
      files.not_descended.emplace_back(entry.path(), count);
    }
  }
}

void add_files(const fs::path& folder, bool recursive, FolderFiles& files) {
  std::error_code failure, error;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure)) {
    const fs::path& path = entry->path();
    if (is_hidden(path)) continue;
    if (entry->is_directory(error)) {
      add_subfolder(*entry, recursive, files);
    } else if (!is_yaml(path)) {
      files.others.push_back(path);
    } else if (is_result(path)) {
      ++files.results;
    } else {
      files.yaml.push_back(path);
    }
  }
  if (failure)
    files.faults.push_back(fmt::format("{}: cannot read this folder: {}", folder.string(), failure.message()));
}

constexpr std::string_view kModulePaths[] = {kPluginKey, kPythonKey};

/// Returns the value as YAML that every reader takes as this text.
std::string quoted_text(const std::string& text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./";
  if (text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

std::string from_folder(const std::string& path, const fs::path& folder) {
  return quoted_text((folder / path).lexically_normal().string());
}

/// Returns the number of bytes of a scalar as written at the start of a text. @param node  the scalar.
size_t written_length(const std::string& text, const Node& node) {
  if (!node.quoted) return node.text.size();
  const size_t end = text.find(text[0], 1);
  return end == std::string::npos ? text.size() : end + 1;
}

/// Replaces the path of a map such as {plugin: lib.so, module: mine}.
std::string with_module_path(const std::string& value, const fs::path& folder) {
  ErrorList errors("value");
  const Node root = parse_yaml(value, "value", errors);
  if (!errors.empty() || root.kind != Node::Kind::map) return value;
  for (const std::string_view key : kModulePaths) {
    const Node* const path = root.find(key);
    if (!path || path->kind != Node::Kind::scalar || path->text.empty() || path->position.line != 1) continue;
    const auto begin = static_cast<size_t>(path->position.column - 1);
    if (begin >= value.size()) continue;
    const size_t length = written_length(value.substr(begin), *path);
    return value.substr(0, begin) + from_folder(path->text, folder) + value.substr(begin + length);
  }
  return value;
}

}  // namespace

FolderFiles files_of(const fs::path& folder, bool recursive) {
  FolderFiles files{.folder = folder, .yaml = {}, .others = {}, .not_descended = {}, .links = {}, .faults = {}};
  add_files(folder, recursive, files);
  std::ranges::sort(files.yaml);
  std::ranges::sort(files.others);
  std::ranges::sort(files.not_descended);
  std::ranges::sort(files.links);
  std::ranges::sort(files.faults);
  return files;
}

void read_each(const FolderFiles& files, const std::function<void(const fs::path&)>& read,
               const std::function<std::set<fs::path>()>& used) {
  std::vector<fs::path> parts;
  for (const fs::path& file : files.yaml) {
    ErrorList ignored("file");
    const Node root = load_tree(file, ignored);
    if (ignored.empty() && !root.incomplete && !is_command_file(root)) {
      parts.push_back(file);
    } else {
      read(file);
    }
  }
  const std::set<fs::path> in_use = parts.empty() ? std::set<fs::path>() : used();
  std::error_code error;
  for (const fs::path& part : parts) {
    if (!in_use.contains(fs::weakly_canonical(part, error))) read(part);
  }
}

std::string left_out_words(const FolderFiles& files, const std::set<fs::path>& used) {
  constexpr size_t kMaxNames = 8;
  std::vector<std::string> names;
  size_t unnamed = 0;
  for (const fs::path& file : files.others) {
    std::error_code error;
    if (used.contains(fs::weakly_canonical(file, error))) continue;
    if (names.size() < kMaxNames) {
      names.push_back(file.lexically_relative(files.folder).string());
    } else {
      ++unnamed;
    }
  }
  std::vector<std::string> words;
  if (!names.empty()) {
    words.push_back(fmt::format("{}{} (not .yaml or .yml)", fmt::join(names, ", "),
                                unnamed > 0 ? fmt::format(" and {} more files", unnamed) : ""));
  }
  for (const auto& [folder, count] : files.not_descended) {
    words.push_back(fmt::format("{}/ ({}; use --recursive)", folder.lexically_relative(files.folder).string(),
                                counted(count, "YAML file")));
  }
  for (const fs::path& link : files.links) {
    words.push_back(
        fmt::format("{}/ (a link; name the folder itself)", link.lexically_relative(files.folder).string()));
  }
  if (files.results > 0) words.push_back(fmt::format("{} scenarios that flights wrote as results", files.results));
  return words.empty() ? "" : fmt::format("{}: left out: {}", files.folder.string(), fmt::join(words, "; "));
}

std::vector<std::string> with_module_paths(std::vector<std::string> overrides, const fs::path& folder) {
  for (std::string& text : overrides) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos) continue;
    const std::string path = text.substr(0, equals), value = text.substr(equals + 1);
    const auto ends_with_key = [&](std::string_view key) { return path.ends_with("avoidance." + std::string(key)); };
    if (path == "avoidance" || path == "takeover.avoidance") {
      text = path + "=" + with_module_path(value, folder);
    } else if (std::ranges::any_of(kModulePaths, ends_with_key)) {
      ErrorList errors("value");
      const Node node = parse_yaml(value, "value", errors);
      if (errors.empty() && node.kind == Node::Kind::scalar) text = path + "=" + from_folder(node.text, folder);
    }
  }
  return overrides;
}

OverridePositions override_positions(const Node& root, const fs::path& folder) {
  OverridePositions positions;
  for (const Node& item : root.items) positions.merge(override_positions(item, folder));
  for (const Entry& entry : root.entries) {
    positions.merge(override_positions(entry.value, folder));
    if (entry.key != "set") continue;
    for (const Node& item : entry.value.items) {
      positions.try_emplace(with_module_paths({item.text}, folder).front(), item.position);
    }
  }
  return positions;
}

std::vector<std::string> at_overrides(std::vector<std::string> faults, const std::vector<std::string>& overrides,
                                      const OverridePositions& positions) {
  for (std::string& fault : faults) {
    for (auto text = overrides.rbegin(); text != overrides.rend(); ++text) {
      const std::string prefix = "--set " + text->substr(0, text->find('=')) + ": ";
      if (!fault.starts_with(prefix)) continue;
      if (const auto found = positions.find(*text); found != positions.end())
        fault = fmt::format("{}: {}", found->second.text(), fault.substr(prefix.size()));
      break;
    }
  }
  return faults;
}

}  // namespace hedgehop::sim
