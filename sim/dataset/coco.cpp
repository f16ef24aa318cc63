#include "sim/dataset/coco.h"

#include "sim/config/utf8.h"

#include <algorithm>
#include <map>

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
using scenes::SemanticClass;

bool is_thing(SemanticClass kind) {
  return kind != SemanticClass::ground && kind != SemanticClass::road && kind != SemanticClass::ceiling;
}

/// The mask of a label: lengths of runs outside and inside it by turns, column by column.
struct Mask {
  std::vector<int64_t> counts;
  int64_t end = 0;  ///< of the last run, pixels in the order of columns
  int64_t area = 0;
  int left = 0, top = 0, right = 0, bottom = 0;

  void add(int64_t begin, int length, int col, int row) {
    if (counts.empty()) {
      left = right = col;
      top = row;
      bottom = row + length;
    }
    if (!counts.empty() && begin == end) {  // goes on at the top of the next column
      counts.back() += length;
    } else {
      counts.push_back(begin - end);
      counts.push_back(length);
    }
    end = begin + length;
    area += length;
    right = std::max(right, col + 1);
    top = std::min(top, row);
    bottom = std::max(bottom, row + length);
  }
};

std::map<int, Mask> masks_of(const cv::Mat& labels) {
  std::map<int, Mask> masks;
  for (int col = 0; col < labels.cols; ++col) {
    for (int row = 0; row < labels.rows;) {
      const int label = labels.at<uint16_t>(row, col);
      int end = row + 1;
      while (end < labels.rows && labels.at<uint16_t>(end, col) == label) ++end;
      if (label > 0) masks[label].add(int64_t{col} * labels.rows + row, end - row, col, row);
      row = end;
    }
  }
  return masks;
}

}  // namespace

void CocoImages::add(size_t id, const std::string& file, const cv::Mat& labels) {
  images_.push_back({{"id", id}, {"file_name", file}, {"width", labels.cols}, {"height", labels.rows}});
  for (auto& [label, mask] : masks_of(labels)) {
    const scenes::Instance& instance = instances_.at(static_cast<size_t>(label - 1));
    if (!is_thing(instance.kind)) continue;
    if (const int64_t rest = int64_t{labels.cols} * labels.rows - mask.end; rest > 0) mask.counts.push_back(rest);
    annotations_.push_back({{"image_id", id},
                            {"category_id", scenes::class_id(instance.kind)},
                            {"instance_id", label},
                            {"bbox", {mask.left, mask.top, mask.right - mask.left, mask.bottom - mask.top}},
                            {"area", mask.area},
                            {"iscrowd", 0},
                            {"segmentation", {{"size", {labels.rows, labels.cols}}, {"counts", mask.counts}}}});
  }
}

std::string CocoImages::json() const { return json_text(Json{{"images", images_}, {"annotations", annotations_}}); }

std::string join_coco(const std::vector<std::string>& worlds) {
  Json joined{{"images", Json::array()}, {"annotations", Json::array()}, {"categories", Json::array()}};
  for (const std::string& text : worlds) {
    Json world = Json::parse(text);
    for (Json& image : world["images"]) joined["images"].push_back(std::move(image));
    for (Json& annotation : world["annotations"]) {
      Json numbered{{"id", joined["annotations"].size() + 1}};
      numbered.update(annotation);
      joined["annotations"].push_back(std::move(numbered));
    }
  }
  for (size_t i = 0; i < scenes::kSemanticClassNames.size(); ++i) {
    const auto kind = static_cast<SemanticClass>(i);
    if (!is_thing(kind)) continue;
    joined["categories"].push_back(
        {{"id", scenes::class_id(kind)}, {"name", std::string(scenes::kSemanticClassNames[i])}});
  }
  return json_text(joined) + "\n";
}

}  // namespace hedgehop::sim
