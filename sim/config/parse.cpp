#include "sim/config/config_tree.h"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "sim/config/syntax_error.h"

namespace hedgehop::sim {
namespace {

constexpr size_t kMaxNodes = 200'000;    // a scenario has hundreds; nested aliases could give billions
constexpr size_t kMaxKeys = 2'000;       // of one map
constexpr size_t kMaxBytes = 4'000'000;  // 200,000 values of 20 letters

/// The document is too large; the rest is not read.
struct TooLarge {
  SourcePosition position;
  std::string what;
};

size_t count_nodes(const Node& node) {
  size_t count = 1;
  for (const Node& item : node.items) count += count_nodes(item);
  for (const Entry& entry : node.entries) count += count_nodes(entry.value);
  return count;
}

/// Builds a Node from the parser's events.
class Builder : public YAML::EventHandler {
 public:
  Builder(std::string file, ErrorList& errors) : file_(std::move(file)), errors_(errors) {}

  Node take() { return std::move(root_); }
  /// Start of the innermost list or map that has no end yet; line 0 if there is none.
  SourcePosition container() const { return open_.empty() ? SourcePosition() : open_.back().node.position; }
  /// Start of the last scalar if that is quoted.
  const std::optional<SourcePosition>& last_quote() const { return last_quote_; }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Node node = make(Node::Kind::null, mark, "");
    // The parser marks an empty value at the next token; the position of its key is clearer.
    if (!open_.empty() && open_.back().has_key && node.position.line > open_.back().key_position.line) {
      node.position = open_.back().key_position;
    }
    add(std::move(node), anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    Node node = make(Node::Kind::scalar, mark, tag);
    node.text = value;
    node.quoted = tag == "!";
    last_quote_ = node.quoted ? std::optional(node.position) : std::nullopt;
    add(std::move(node), anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto named = anchors_.find(anchor);
    Node node = make(Node::Kind::null, mark, "");
    if (named == anchors_.end()) {
      errors_.add(node.position, "an alias is inside its own anchor");
    } else if (const size_t count = count_nodes(named->second); nodes_ + count > kMaxNodes) {
      if (!too_many_) errors_.add(node.position, "aliases make the document too large");
      too_many_ = true;
    } else {
      nodes_ += count;
      node = named->second;
    }
    add(std::move(node), 0);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open_.push_back({make(Node::Kind::list, mark, tag), anchor});
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open_.push_back({make(Node::Kind::map, mark, tag), anchor});
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    Node node;
    YAML::anchor_t anchor = 0;
    bool has_key = false;  ///< of a map: a key has no value yet
    bool drop = false;     ///< ... which is discarded
    std::string key = {};
    SourcePosition key_position = {};
  };

  Node make(Node::Kind kind, const YAML::Mark& mark, const std::string& tag) {
    Node node;
    node.kind = kind;
    node.position = {file_, mark.line + 1, mark.column + 1};
    if (!tag.empty() && tag != "?" && tag != "!")
      errors_.add(node.position, fmt::format("tag '{}' is not allowed", tag));
    return node;
  }

  std::string path() const {
    std::string path;
    for (const Open& open : open_) {
      if (open.node.kind == Node::Kind::list) {
        path = join_path(path, std::to_string(open.node.items.size()));
      } else if (open.has_key) {
        path = join_path(path, open.key);
      }
    }
    return path;
  }

  void add(Node node, YAML::anchor_t anchor) {
    if (++nodes_ > kMaxNodes) throw TooLarge{node.position, fmt::format("more than {} values in one file", kMaxNodes)};
    if (anchor != 0) anchors_[anchor] = node;
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& open = open_.back();
    if (open.node.kind == Node::Kind::list) {
      open.node.items.push_back(std::move(node));
    } else if (!open.has_key) {
      take_key(open, node);
    } else {
      if (!open.drop) open.node.entries.push_back({open.key, open.key_position, std::move(node)});
      open.has_key = false;
    }
  }

  void take_key(Open& open, const Node& key) {
    const std::string in = errors_.path_text(path());
    if (open.node.entries.size() >= kMaxKeys) {
      throw TooLarge{key.position, fmt::format("more than {} keys in {}", kMaxKeys, in)};
    }
    open.has_key = true;
    open.drop = true;
    open.key = key.text;
    open.key_position = key.position;
    if (key.kind != Node::Kind::scalar || key.text.empty()) {
      errors_.add(key.position, fmt::format("a key in {} must be one word, got {}", in, key.description()));
    } else if (key.text == "<<") {
      errors_.add(key.position, fmt::format("merge key '<<' in {} is not allowed; use 'use: file.yaml'", in));
    } else if (const auto first = std::ranges::find(open.node.entries, key.text, &Entry::key);
               first != open.node.entries.end()) {
      errors_.add(key.position,
                  fmt::format("duplicate key '{}' in {}; first at line {}", key.text, in, first->position.line));
    } else {
      open.drop = false;
    }
  }

  void close() {
    Open closed = std::move(open_.back());
    open_.pop_back();
    add(std::move(closed.node), closed.anchor);
  }

  std::string file_;
  ErrorList& errors_;
  Node root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Node> anchors_;
  size_t nodes_ = 0;
  bool too_many_ = false;
  std::optional<SourcePosition> last_quote_;
};

/// Returns why a text is not scanned, which costs up to 130 bytes and 0.2 us per letter; empty if it is scanned.
std::string size_error(const std::string& text) {
  if (text.size() > kMaxBytes) return fmt::format("more than {} MB of YAML", kMaxBytes / 1'000'000);
  const auto opens = std::ranges::count_if(text, [](char c) { return c == '[' || c == '{'; });
  return static_cast<size_t>(opens) > kMaxNodes ? fmt::format("more than {} lists and maps", kMaxNodes) : "";
}

void parse(const std::string& text, Builder& builder) {
  std::istringstream stream(text);
  YAML::Parser(stream).HandleNextDocument(builder);
}

/// Returns the start of a quote without an end. The parser reports such a quote only if no line break follows it.
std::optional<SourcePosition> unclosed_quote(const std::string& text, const std::string& file) {
  ErrorList ignored("");
  bool is_unclosed = false;
  try {
    Builder builder(file, ignored);
    parse(text.substr(0, text.find_last_not_of(" \t\r\n") + 1), builder);
  } catch (const YAML::Exception& error) {
    is_unclosed = error.msg == YAML::ErrorMsg::EOF_IN_SCALAR;
  } catch (const TooLarge&) {
  }
  if (!is_unclosed) return {};
  Builder builder(file, ignored);
  try {
    parse(text + "\n", builder);
  } catch (const YAML::Exception&) {  // a list around the quote has no end either
  }
  return builder.last_quote();
}

}  // namespace

Node parse_yaml(const std::string& text, const std::string& file, ErrorList& errors) {
  if (std::string error = size_error(text); !error.empty()) {
    errors.add({file, 1, 1}, std::move(error));
    return {};
  }
  std::istringstream stream(text);
  Builder builder(file, errors);
  try {
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) {
      errors.add({file, 1, 1}, "the file is empty");
      return {};
    }
    Node root = builder.take();
    if (const auto quote = builder.last_quote() ? unclosed_quote(text, file) : std::nullopt) {
      add_syntax_error(text, {*quote, YAML::ErrorMsg::EOF_IN_SCALAR, {}}, errors);
      return {};
    }
    ErrorList ignored(errors.kind());
    Builder second(file, ignored);
    if (parser.HandleNextDocument(second)) {
      const Node next = second.take();
      errors.add(next.position, "a second document; one file holds one");
    }
    return root;
  } catch (const TooLarge& large) {
    errors.add(large.position, large.what);
    return {};
  } catch (const YAML::DeepRecursion& error) {
    errors.add({file, error.mark.line + 1, error.mark.column + 1}, "lists and maps are nested too deeply");
  } catch (const YAML::Exception& error) {
    const auto quote = unclosed_quote(text, file);
    const SourcePosition stop{file, error.mark.line + 1, error.mark.column + 1};
    add_syntax_error(
        text, {quote.value_or(stop), quote ? YAML::ErrorMsg::EOF_IN_SCALAR : error.msg, builder.container()}, errors);
  } catch (const std::exception& error) {
    errors.add({file, 0, 0}, fmt::format("cannot be read as YAML: {}", error.what()));
  }
  return {};
}

}  // namespace hedgehop::sim
