#include "sim/config/include.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

#include "sim/config/input_file.h"
#include "sim/config/parse.h"

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;

/// Keys that choose the avoidance module.
constexpr std::array<std::string_view, 3> kModuleKeys = {kModuleSelector, kPythonKey, kPluginKey};

bool is_selector(std::string_view key) {
  return std::find(std::begin(kSelectors), std::end(kSelectors), key) != std::end(kSelectors);
}

/// Whether a key with this value chooses something else than what the map holds.
bool chooses_another(const Node& map, std::string_view key, const Node& value) {
  const auto is_module = [&](std::string_view other) { return other != key && map.find(other); };
  const bool foreign = key == kPythonKey || key == kPluginKey;
  if (foreign && !map.find(key)) return std::ranges::any_of(kModuleKeys, is_module);
  if (key == kModuleSelector && map.find(kPythonKey)) return true;
  const Node* old = map.find(key);
  return is_selector(key) && old && old->kind == Node::Kind::scalar && old->text != value.text;
}

/// Whether `over` names another choice than `base`.
bool changes_choice(const Node& base, const Node& over) {
  return std::ranges::any_of(over.entries,
                             [&](const Entry& entry) { return chooses_another(base, entry.key, entry.value); });
}

void set_places(Node& node, const Place& place) {
  node.place = place;
  for (Node& item : node.items) set_places(item, place);
  for (Entry& entry : node.entries) {
    entry.place = place;
    set_places(entry.value, place);
  }
}

/// What to say of a scenario that is not there, where others are installed.
std::string where_scenarios_are(const fs::path& file) {
  std::error_code error;
  const fs::path installed = installed_configs();
  if (installed.empty() || fs::exists(file, error)) return {};
  return fmt::format("; the installed scenarios: cp -r {} .", installed.string());
}

/// Reads files and the files that they use, and knows which are being read.
class Includer {
 public:
  Includer(Faults& faults, std::set<fs::path>& read) : faults_(faults), read_(read) {}

  /// @param from  place of the `use` that names it, or null for the scenario itself.
  Node load(const fs::path& file, const Place* from) {
    const std::string name = file.lexically_normal().string();
    const Place place = from ? *from : Place{name, 0, 0};
    std::error_code error;
    const fs::path identity = fs::weakly_canonical(file, error);
    if (const auto same = std::find(identities_.begin(), identities_.end(), identity); same != identities_.end()) {
      std::string circle;
      for (auto i = same - identities_.begin(); i < std::ssize(names_); ++i)
        circle += names_[static_cast<size_t>(i)] + " -> ";
      faults_.add(place, fmt::format("'use' runs in a circle: {}{}", circle, name));
      return {};
    }
    if (++files_ > kMostFiles) {
      if (files_ == kMostFiles + 1) faults_.add(place, fmt::format("more than {} files are used", kMostFiles));
      return {};
    }

    std::string text;
    try {
      text = read_input_file(file);
    } catch (const std::invalid_argument& why) {
      faults_.add(place, from ? fmt::format("{}: '{}'", why.what(), name) : why.what() + where_scenarios_are(file));
      return {};
    }
    read_.insert(file.lexically_normal());
    return parse(text, name, file.parent_path(), identity);
  }

  /// @param identity  of the file that the text comes from.
  Node parse(const std::string& text, const std::string& name, const fs::path& folder, const fs::path& identity) {
    const size_t faults_before = faults_.count();
    Node root = parse_yaml(text, name, faults_);
    if (root.kind != Node::Kind::map && faults_.count() == faults_before) {
      faults_.add(root.place, fmt::format("expected a map of keys, got {}", root.words()));
    }
    identities_.push_back(identity);
    names_.push_back(name);
    expand(root, folder);
    identities_.pop_back();
    names_.pop_back();
    return root;
  }

  /// Replaces every `use` under `node`.
  void expand(Node& node, const fs::path& folder) {
    for (Node& item : node.items) expand(item, folder);
    for (Entry& entry : node.entries) {
      if (entry.key != "use") expand(entry.value, folder);
    }
    const auto use =
        std::find_if(node.entries.begin(), node.entries.end(), [](const Entry& e) { return e.key == "use"; });
    if (use == node.entries.end()) return;

    const Entry used = *use;
    node.entries.erase(use);
    if (used.value.kind != Node::Kind::scalar || used.value.text.empty()) {
      faults_.add(used.value.place, fmt::format("'use' expects the path of a file, got {}", used.value.words()));
      return;
    }
    Node base = load(folder / used.value.text, &used.value.place);
    node.incomplete = base.kind != Node::Kind::map;
    if (node.incomplete) return;
    base.place = node.place;
    override_with(base, node);
    node = std::move(base);
  }

 private:
  static constexpr int kMostFiles = 1000;

  Faults& faults_;
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

/// Item or value under `node`, made when a map lacks it; null, with a fault, where nothing can be.
Node* step_into(Node& node, const std::string& key, const std::string& path, const Place& place, Faults& faults) {
  if (node.kind == Node::Kind::list) {
    size_t index = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
    if (error == std::errc() && end == key.data() + key.size() && index < node.items.size()) return &node.items[index];
    faults.add(place,
               fmt::format("{} has no item '{}'; it has {} items, from 0", path_words(path), key, node.items.size()));
    return nullptr;
  }
  if (node.kind == Node::Kind::scalar) {
    faults.add(place,
               fmt::format("{} is the single value {}; it has no key '{}'", path_words(path), node.words(), key));
    return nullptr;
  }
  if (node.kind == Node::Kind::null) {
    node = Node{};
    node.kind = Node::Kind::map;
    node.place = place;
  }
  if (Node* found = node.find(key)) return found;
  node.entries.push_back({key, place, Node{}});
  node.entries.back().value.place = place;
  return &node.entries.back().value;
}

void apply_override(Node& root, const std::string& text, const fs::path& folder, Includer& includer, Faults& faults) {
  const size_t equals = text.find('=');
  const std::string path_text = text.substr(0, equals);
  const Place place{"--set " + path_text, 0, 0};
  std::vector<std::string> keys = split_path(path_text);
  if (equals == std::string::npos || std::find(keys.begin(), keys.end(), "") != keys.end()) {
    faults.add({"--set " + text, 0, 0}, "expected key.path=value");
    return;
  }

  const std::string value_text = text.substr(equals + 1);
  Faults of_value;
  Node value = value_text.empty() ? Node{} : parse_yaml(value_text, place.file, of_value);
  if (!of_value.empty()) {
    faults.add(place, fmt::format("'{}' is not a YAML value", value_text));
    return;
  }
  set_places(value, place);
  if (keys.back() == "use" && keys.size() > 1) {
    Node map;
    map.kind = Node::Kind::map;
    map.place = place;
    map.entries.push_back({"use", place, std::move(value)});
    value = std::move(map);
    keys.pop_back();
  }
  includer.expand(value, folder);

  Node* node = &root;
  std::string path;
  for (size_t i = 0; i < keys.size(); ++i) {
    // Another choice of type takes the other keys of the old one with it.
    // A library leaves the module's name, which may have been set before it.
    if (i + 1 == keys.size() && keys[i] != kPluginKey && chooses_another(*node, keys[i], value)) {
      node->entries.clear();
    }
    node = step_into(*node, keys[i], path, place, faults);
    if (!node) return;
    path = join_path(path, keys[i]);
  }
  *node = std::move(value);
}

}  // namespace

void override_with(Node& base, const Node& over) {
  if (base.kind != Node::Kind::map || over.kind != Node::Kind::map || changes_choice(base, over)) {
    base = over;
    return;
  }
  base.place = over.place;
  for (const Entry& entry : over.entries) {
    const auto same =
        std::find_if(base.entries.begin(), base.entries.end(), [&](const Entry& e) { return e.key == entry.key; });
    if (same == base.entries.end()) {
      base.entries.push_back(entry);
    } else {
      same->place = entry.place;
      override_with(same->value, entry.value);
    }
  }
}

Node load_tree(const fs::path& file, Faults& faults, std::set<fs::path>& read) {
  return Includer(faults, read).load(file, nullptr);
}

Node parse_tree(const std::string& text, const std::string& name, Faults& faults, std::set<fs::path>& read) {
  return Includer(faults, read).parse(text, name, {}, {});
}

Node load_tree(const fs::path& file, Faults& faults) {
  std::set<fs::path> read;
  return load_tree(file, faults, read);
}

void apply_overrides(Node& root, std::span<const std::string> overrides, const fs::path& file, Faults& faults,
                     std::set<fs::path>& read) {
  Includer includer(faults, read);
  for (const std::string& text : overrides) apply_override(root, text, file.parent_path(), includer, faults);
}

}  // namespace hedgehop::sim
