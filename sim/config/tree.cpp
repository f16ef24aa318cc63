#include "sim/config/tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "sim/config/input_error.h"

namespace hedgehop::sim {

std::string Place::text() const { return line > 0 ? fmt::format("{}:{}:{}", file, line, column) : file; }

const Node* Node::find(std::string_view key) const {
  for (const Entry& entry : entries) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

Node* Node::find(std::string_view key) {
  for (Entry& entry : entries) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

std::string Node::words() const {
  switch (kind) {
    case Kind::null:
      return "nothing";
    case Kind::list:
      return "a list";
    case Kind::map:
      return "a map";
    case Kind::scalar:
      break;
  }
  constexpr size_t kMostLetters = 80;
  const bool is_long = text.size() > kMostLetters;
  return fmt::format("{}'{}'", quoted ? "the text " : "", is_long ? text.substr(0, kMostLetters) + "..." : text);
}

void Faults::add(const Place& place, std::string message) {
  if (++count_ <= kMost) faults_.push_back({place, std::move(message)});
}

void Faults::raise() const {
  if (faults_.empty()) return;
  std::vector<std::string_view> files;
  for (const Fault& fault : faults_) {
    if (std::find(files.begin(), files.end(), fault.place.file) == files.end()) files.push_back(fault.place.file);
  }
  std::vector<std::string> lines;
  for (std::string_view file : files) {
    std::vector<const Fault*> of_file;
    for (const Fault& fault : faults_) {
      if (fault.place.file == file) of_file.push_back(&fault);
    }
    std::stable_sort(of_file.begin(), of_file.end(), [](const Fault* a, const Fault* b) {
      return std::pair(a->place.line, a->place.column) < std::pair(b->place.line, b->place.column);
    });
    for (const Fault* fault : of_file) {
      std::string line = fault->place.text() + ": " + fault->message;
      if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(std::move(line));
    }
  }
  if (count_ > kMost) lines.push_back(fmt::format("and {} more", count_ - kMost));
  throw InputError(std::move(lines));
}

std::string join_path(std::string_view parent, std::string_view key) {
  return parent.empty() ? std::string(key) : fmt::format("{}.{}", parent, key);
}

std::string path_words(std::string_view path) {
  return path.empty() ? std::string("the scenario") : fmt::format("'{}'", path);
}

Place place_of(const Node& root, std::string_view path) {
  const Node* node = &root;
  while (!path.empty()) {
    const size_t dot = path.find('.');
    const std::string_view key = path.substr(0, dot);
    const Node* next = node->find(key);
    size_t index = 0;
    if (node->kind == Node::Kind::list &&
        std::from_chars(key.data(), key.data() + key.size(), index).ec == std::errc() && index < node->items.size()) {
      next = &node->items[index];
    }
    if (!next) break;
    node = next;
    path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
  }
  return node->place;
}

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i) {
    for (size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = static_cast<int>(i + j);
        continue;
      }
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::string suggestion(std::string_view word, const std::vector<std::string_view>& allowed) {
  constexpr size_t kLongestWord = 100;
  std::string_view nearest;
  int nearest_distance = 0;
  for (std::string_view candidate : allowed) {
    if (word.size() > kLongestWord) break;
    const int distance = edit_distance(word, candidate);
    const size_t shorter = std::min(word.size(), candidate.size()), longer = std::max(word.size(), candidate.size());
    const bool one_begins_other = shorter >= 3 && word.substr(0, shorter) == candidate.substr(0, shorter);
    const bool near = one_begins_other || static_cast<size_t>(distance) * 3 <= longer;
    if (near && (nearest.empty() || distance < nearest_distance)) {
      nearest = candidate;
      nearest_distance = distance;
    }
  }
  const std::string guess = nearest.empty() ? "; " : fmt::format("; did you mean '{}'? ", nearest);
  return fmt::format("{}allowed: {}", guess, allowed.empty() ? "none" : fmt::format("{}", fmt::join(allowed, ", ")));
}

}  // namespace hedgehop::sim
