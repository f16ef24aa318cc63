#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hedgehop::sim {

/// A drawing of lines, shapes and text that is written as SVG or PDF. Lengths are in points, 1/72 inch; x is right, y
/// is down. Text is set in Helvetica, which every PDF viewer has.
class FigureCanvas {
 public:
  enum class Anchor { left, center, right };
  struct Point {
    double x = 0.0, y = 0.0;
  };
  /// @param fill, stroke  color such as "#0072b2"; empty for none.
  struct Style {
    std::string fill, stroke;
    double width = 0.75;
    bool dashed = false;
  };

  FigureCanvas(double width, double height) : width_(width), height_(height) {}

  double width() const { return width_; }
  double height() const { return height_; }
  void line(const std::vector<Point>& points, const Style& style);
  void rectangle(Point corner, double width, double height, const Style& style);
  void circle(Point center, double radius, const Style& style);
  /// @param upward  whether the text reads from bottom to top.
  void text(Point at, std::string_view words, double size, Anchor anchor = Anchor::left, bool upward = false,
            std::string_view color = "#1b2330");

  std::string svg() const;
  /// Returns a PDF 1.4 of one page. Letters beyond ASCII are written as '?'.
  std::string pdf() const;

  /// Returns the width of a text in Helvetica.
  static double text_width(std::string_view words, double size);

 private:
  struct Item {
    enum class Kind { line, rectangle, circle, text } kind;
    std::vector<Point> points;
    double a = 0.0, b = 0.0;  ///< width and height; radius; size of text
    Style style = {};
    std::string words = {};
    Anchor anchor = Anchor::left;
    bool upward = false;
  };
  double width_, height_;
  std::vector<Item> items_;
};

}  // namespace hedgehop::sim
