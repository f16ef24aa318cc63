#include "sim/scenario/calibration_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core/persistence.hpp>

#include "sim/config/input_error.h"
#include "sim/config/numbers.h"

namespace hedgehop::sim {
namespace {

/// Converts OpenCV's tree.
Node to_node(const cv::FileNode& from, const std::string& file) {
  Node node;
  node.position = {.file = file};
  if (from.isMap()) {
    node.kind = Node::Kind::map;
    for (const cv::FileNode item : from) node.entries.push_back({item.name(), node.position, to_node(item, file)});
  } else if (from.isSeq()) {
    node.kind = Node::Kind::list;
    for (const cv::FileNode item : from) node.items.push_back(to_node(item, file));
  } else if (from.isInt() || from.isReal()) {
    node.kind = Node::Kind::scalar;
    node.text = number_text(static_cast<double>(from), false);
  } else if (from.isString()) {
    node.kind = Node::Kind::scalar;
    node.text = static_cast<std::string>(from);
  }
  return node;
}

Node parse_xml(const std::string& text, const std::string& file) {
  try {
    const cv::FileStorage storage(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    return to_node(storage.root(), file);
  } catch (const cv::Exception&) {  // its text names functions of OpenCV
    throw InputError(
        fmt::format("{}: is not complete XML, or is not a file of cv::FileStorage (<opencv_storage>)", file));
  }
}

/// Cuts the end of a document, which `ros2 topic echo` writes after each message.
void cut_document_end(std::string& text) {
  const size_t end = text.find_last_not_of(" \t\r\n");
  const size_t line = end == std::string::npos ? end : text.rfind('\n', end);
  if (line == std::string::npos) return;
  const std::string last = text.substr(line + 1, end - line);
  if (last == "---" || last == "...") text.erase(line + 1);
}

/// Parses YAML with OpenCV's header and tags, which standard YAML lacks.
Node parse_yaml_of_opencv(std::string text, const std::string& file) {
  constexpr std::string_view kTag = "!!opencv-";
  for (size_t at = text.find(kTag); at != std::string::npos; at = text.find(kTag, at)) {
    text.erase(at, text.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", at + kTag.size()) - at);
  }
  cut_document_end(text);
  if (text.starts_with("%YAML")) text.erase(0, std::min(text.find('\n'), text.size()));
  ErrorList errors("calibration");
  Node root = parse_yaml(text, file, errors);
  errors.throw_if_any();
  return root;
}

}  // namespace

Node parse_calibration_text(const std::string& text, const std::string& file) {
  const size_t first = text.find_first_not_of(" \t\r\n");
  const bool is_xml = first != std::string::npos && text[first] == '<';
  return is_xml ? parse_xml(text, file) : parse_yaml_of_opencv(text, file);
}

bool is_ocam_calibration(const std::string& text) {
  constexpr std::string_view kSpace = " \t\r\n\v\f", kStart = "+-.0123456789", kNumbers = "+-.0123456789eE \t\r";
  size_t at = text.find_first_not_of(kSpace);
  while (at != std::string::npos && text[at] == '#') at = text.find_first_not_of(kSpace, text.find('\n', at));
  if (at == std::string::npos || kStart.find(text[at]) == std::string_view::npos) return false;
  return text.find_first_not_of(kNumbers, at) >= text.find('\n', at);
}

}  // namespace hedgehop::sim
