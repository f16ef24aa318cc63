#include "sim/config/include.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

#include "sim/config/config_tree.h"
#include "sim/config/other_units.h"
#include "sim/config/whole_file.h"

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;

/// Keys that exclude each other because each chooses the module.
constexpr std::array<std::string_view, 3> kModuleKeys = {kModuleSelector, kPythonKey, kPluginKey};
/// Keys of a library's module, which may be set before `plugin`.
constexpr std::array<std::string_view, 4> kLibraryKeys = {kModuleSelector, kParametersKey, "limit", "in_process"};
bool is_override(const Node& value) { return value.position.file.starts_with("--set "); }

/// Whether a key with this value chooses another alternative than the map does.
bool chooses_another(const Node& map, std::string_view key, const Node& value) {
  const auto is_module = [&](std::string_view other) { return other != key && map.find(other); };
  const bool foreign = key == kPythonKey || key == kPluginKey;
  if (foreign && !map.find(key)) return std::ranges::any_of(kModuleKeys, is_module);
  if (key == kModuleSelector && map.find(kPythonKey)) return true;
  const Node *old = map.find(key), *library = map.find(kPluginKey);
  if (key == kModuleSelector && library && is_override(*library)) return false;  // the library's module
  if (!old || std::ranges::find(kSelectors, key) == std::end(kSelectors)) return false;
  return old->kind == Node::Kind::scalar && old->text != value.text;
}

/// Whether `over` chooses another alternative than `base`.
bool changes_choice(const Node& base, const Node& over) {
  return std::ranges::any_of(over.entries,
                             [&](const Entry& entry) { return chooses_another(base, entry.key, entry.value); });
}

void set_positions(Node& node, const SourcePosition& position) {
  node.position = position;
  for (Node& item : node.items) set_positions(item, position);
  for (Entry& entry : node.entries) {
    entry.position = position;
    set_positions(entry.value, position);
  }
}

/// Returns advice for a missing scenario if scenarios are installed.
std::string installed_scenarios_advice(const fs::path& file) {
  std::error_code error;
  const fs::path installed = installed_configs();
  if (installed.empty() || fs::status(file, error).type() != fs::file_type::not_found) return {};
  return fmt::format("; the installed scenarios: cp -r {} .", installed.string());
}

/// Reads files and the files that they use, and detects circles.
class Includer {
 public:
  Includer(ErrorList& errors, std::set<fs::path>& read) : errors_(errors), read_(read) {}

  /// @param from  position of the `use` that names it; null for the first file.
  /// @param key  of the map that the file gives.
  Node load(const fs::path& file, const SourcePosition* from, std::string_view key = "") {
    const std::string name = file.lexically_normal().string();
    const SourcePosition position = from ? *from : SourcePosition{name, 0, 0};
    std::error_code error;
    const fs::path identity = fs::weakly_canonical(file, error);
    if (const auto same = std::find(identities_.begin(), identities_.end(), identity); same != identities_.end()) {
      std::string circle;
      for (auto i = same - identities_.begin(); i < std::ssize(names_); ++i)
        circle += names_[static_cast<size_t>(i)] + " -> ";
      errors_.add(position, fmt::format("'use' forms a circle: {}{}", circle, name));
      return {};
    }
    if (++files_ > kMaxFiles) {
      if (files_ == kMaxFiles + 1) errors_.add(position, fmt::format("more than {} files are used", kMaxFiles));
      return {};
    }

    std::string text;
    try {
      text = read_input_file(file);
    } catch (const std::invalid_argument& why) {
      const bool of_override = from && file.is_relative() && from->file.starts_with("--set ");
      const std::string place = of_override ? " (relative to the scenario's folder)" : "";
      errors_.add(position, from ? fmt::format("{}: '{}'{}", why.what(), name, place)
                                 : why.what() + installed_scenarios_advice(file));
      return {};
    }
    read_.insert(file.lexically_normal());
    return parse(text, name, file.parent_path(), identity, key);
  }

  /// @param identity  of the file that the text comes from.
  Node parse(const std::string& text, const std::string& name, const fs::path& folder, const fs::path& identity,
             std::string_view key = "") {
    const size_t errors_before = errors_.count();
    Node root = parse_yaml(text, name, errors_);
    if (root.kind != Node::Kind::map && errors_.count() == errors_before) {
      errors_.add(root.position, fmt::format("expected a map of keys, got {}", root.description()));
    }
    convert_units(root, key, errors_);
    identities_.push_back(identity);
    names_.push_back(name);
    expand(root, folder, key);
    identities_.pop_back();
    names_.pop_back();
    return root;
  }

  /// Replaces every `use` under `node`.
  /// @param key  of the node; kParametersKey everywhere below a foreign module's parameters, whose units stay.
  void expand(Node& node, const fs::path& folder, std::string_view key) {
    const bool is_foreign = key == kParametersKey;
    for (Node& item : node.items) expand(item, folder, is_foreign ? key : "");
    for (Entry& entry : node.entries) {
      if (entry.key != "use") expand(entry.value, folder, is_foreign ? key : entry.key);
    }
    const auto use =
        std::find_if(node.entries.begin(), node.entries.end(), [](const Entry& e) { return e.key == "use"; });
    if (use == node.entries.end()) return;

    const Entry used = *use;
    node.entries.erase(use);
    if (used.value.kind != Node::Kind::scalar || used.value.text.empty()) {
      errors_.add(used.value.position,
                  fmt::format("'use' expects the path of a file, got {}", used.value.description()));
      return;
    }
    Node base = load(folder / used.value.text, &used.value.position, key);
    node.incomplete = base.kind != Node::Kind::map;
    if (node.incomplete) return;
    base.position = node.position;
    override_with(base, node);
    node = std::move(base);
  }

 private:
  static constexpr int kMaxFiles = 1000;

  ErrorList& errors_;
  std::set<fs::path>& read_;
  std::vector<fs::path> identities_;  ///< files being read, outermost first
  std::vector<std::string> names_;
  int files_ = 0;
};

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> keys(1);
  for (char c : path) {
    if (c == '.') {
      keys.emplace_back();
    } else {
      keys.back() += c;
    }
  }
  return keys;
}

/// Returns the item or value under `node`, which a map gains if it is missing; null, with an error, if it is
/// impossible.
Node* step_into(Node& node, const std::string& key, const std::string& path, const SourcePosition& position,
                ErrorList& errors) {
  if (node.kind == Node::Kind::list) {
    size_t index = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
    if (error == std::errc() && end == key.data() + key.size() && index < node.items.size()) return &node.items[index];
    errors.add(position, fmt::format("{} has no item '{}'; it has {} items, from 0", errors.path_text(path), key,
                                     node.items.size()));
    return nullptr;
  }
  if (node.kind == Node::Kind::scalar) {
    errors.add(position, fmt::format("{} is the single value {}; it has no key '{}'", errors.path_text(path),
                                     node.description(), key));
    return nullptr;
  }
  if (node.kind == Node::Kind::null) {
    node = Node{};
    node.kind = Node::Kind::map;
    node.position = position;
  }
  if (Node* found = node.find(key)) return found;
  node.entries.push_back({key, position, Node{}});
  node.entries.back().value.position = position;
  return &node.entries.back().value;
}

void apply_override(Node& root, const std::string& text, const fs::path& folder, Includer& includer,
                    ErrorList& errors) {
  const size_t equals = text.find('=');
  const std::string path_text = text.substr(0, equals);
  const SourcePosition position{"--set " + path_text, 0, 0};
  std::vector<std::string> keys = split_path(path_text);
  if (equals == std::string::npos || std::find(keys.begin(), keys.end(), "") != keys.end()) {
    errors.add({"--set " + text, 0, 0}, "expected key.path=value");
    return;
  }

  const std::string value_text = text.substr(equals + 1);
  ErrorList of_value(errors.kind());
  Node value = value_text.empty() ? Node{} : parse_yaml(value_text, position.file, of_value);
  if (!of_value.empty()) {
    errors.add(position, fmt::format("'{}' is not a YAML value: {}", value_text, of_value.first_message()));
    return;
  }
  set_positions(value, position);
  if (keys.back() == "use" && keys.size() > 1) {
    Node map;
    map.kind = Node::Kind::map;
    map.position = position;
    map.entries.push_back({"use", position, std::move(value)});
    value = std::move(map);
    keys.pop_back();
  }
  Entry last{std::move(keys.back()), position, std::move(value)};
  const bool is_foreign = std::ranges::find(keys, kParametersKey) != keys.end();
  if (!is_foreign) convert_units(last, keys.size() > 1 ? keys[keys.size() - 2] : "", errors);
  includer.expand(last.value, folder, is_foreign ? kParametersKey : last.key);
  keys.back() = last.key;

  Node* node = &root;
  std::string path;
  for (size_t i = 0; i < keys.size(); ++i) {
    // Another choice discards the keys of the previous choice.
    if (i + 1 == keys.size() && chooses_another(*node, keys[i], last.value)) {
      std::erase_if(node->entries, [&](const Entry& entry) {
        const bool is_library_key = std::ranges::find(kLibraryKeys, entry.key) != kLibraryKeys.end();
        return keys[i] != kPluginKey || !(is_library_key || is_override(entry.value));
      });
    }
    node = step_into(*node, keys[i], path, position, errors);
    if (!node) return;
    path = join_path(path, keys[i]);
  }
  *node = std::move(last.value);
}

}  // namespace

void override_with(Node& base, const Node& over) {
  if (base.kind != Node::Kind::map || over.kind != Node::Kind::map || changes_choice(base, over)) {
    base = over;
    return;
  }
  base.position = over.position;
  for (const Entry& entry : over.entries) {
    const auto same = std::ranges::find(base.entries, entry.key, &Entry::key);
    if (same == base.entries.end()) {
      base.entries.push_back(entry);
    } else {
      same->position = entry.position;
      override_with(same->value, entry.value);
    }
  }
}

Node load_tree(const fs::path& file, ErrorList& errors, std::set<fs::path>& read) {
  return Includer(errors, read).load(file, nullptr);
}

Node parse_tree(const std::string& text, const std::string& name, ErrorList& errors, std::set<fs::path>& read) {
  return Includer(errors, read).parse(text, name, {}, {});
}

Node load_tree(const fs::path& file, ErrorList& errors) {
  std::set<fs::path> read;
  return load_tree(file, errors, read);
}

void apply_overrides(Node& root, std::span<const std::string> overrides, const fs::path& file, ErrorList& errors,
                     std::set<fs::path>& read) {
  Includer includer(errors, read);
  for (const std::string& text : overrides) apply_override(root, text, file.parent_path(), includer, errors);
}

std::filesystem::path installed_configs() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path configs = program.parent_path().parent_path() / "share" / "hedgehop" / "configs";
  return std::filesystem::is_directory(configs, error) ? configs : std::filesystem::path();
}

}  // namespace hedgehop::sim
