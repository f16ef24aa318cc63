#include "sim/pages/figure_canvas.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>
#include <cstdint>

#include "sim/pages/report_page.h"

namespace hedgehop::sim {
namespace {

/// Widths of Helvetica's letters from ' ' to '~', 1/1000 of the size. Source: Adobe's font metrics of Helvetica.
constexpr std::array<int16_t, 95> kWidths = {
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333,  278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
    611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667,  611, 722, 667, 944, 667,
    667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278,  556, 556, 222, 222, 500,
    222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500,  500, 334, 260, 334, 584};

/// Returns the text with '?' for each letter beyond ASCII.
std::string ascii(std::string_view words) {
  std::string text;
  for (const char c : words) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0U) == 0x80U) continue;  // a further byte of a letter
    text += byte < 0x20 || byte > 0x7e ? '?' : c;
  }
  return text;
}

std::string pdf_color(std::string_view color, std::string_view command) {
  std::array<int, 3> parts{};
  for (size_t i = 0; i < 3; ++i) {
    const std::string_view digits = color.substr(1 + 2 * i, 2);
    std::from_chars(digits.data(), digits.data() + digits.size(), parts[i], 16);
  }
  return fmt::format("{:.3f} {:.3f} {:.3f} {}\n", parts[0] / 255.0, parts[1] / 255.0, parts[2] / 255.0, command);
}

std::string svg_style(const FigureCanvas::Style& style) {
  return fmt::format(R"( fill="{}" stroke="{}" stroke-width="{:.2f}"{})", style.fill.empty() ? "none" : style.fill,
                     style.stroke.empty() ? "none" : style.stroke, style.width,
                     style.dashed ? R"( stroke-dasharray="3 2")" : "");
}

std::string pdf_style(const FigureCanvas::Style& style) {
  std::string text = fmt::format("{:.2f} w {} 0 d\n", style.width, style.dashed ? "[3 2]" : "[]");
  if (!style.fill.empty()) text += pdf_color(style.fill, "rg");
  if (!style.stroke.empty()) text += pdf_color(style.stroke, "RG");
  return text;
}

std::string_view paint(const FigureCanvas::Style& style) {
  return style.fill.empty() ? "S" : style.stroke.empty() ? "f" : "B";
}

}  // namespace

double FigureCanvas::text_width(std::string_view words, double size) {
  int sum = 0;
  for (const char c : ascii(words)) sum += kWidths[static_cast<size_t>(c - ' ')];
  return 0.001 * size * sum;
}

void FigureCanvas::line(const std::vector<Point>& points, const Style& style) {
  if (points.size() > 1) items_.push_back({.kind = Item::Kind::line, .points = points, .style = style});
}

void FigureCanvas::rectangle(Point corner, double width, double height, const Style& style) {
  items_.push_back({.kind = Item::Kind::rectangle, .points = {corner}, .a = width, .b = height, .style = style});
}

void FigureCanvas::circle(Point center, double radius, const Style& style) {
  items_.push_back({.kind = Item::Kind::circle, .points = {center}, .a = radius, .style = style});
}

void FigureCanvas::text(Point at, std::string_view words, double size, Anchor anchor, bool upward,
                        std::string_view color) {
  items_.push_back({.kind = Item::Kind::text,
                    .points = {at},
                    .a = size,
                    .style = {.fill = std::string(color), .stroke = ""},
                    .words = std::string(words),
                    .anchor = anchor,
                    .upward = upward});
}

std::string FigureCanvas::svg() const {
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}pt\" height=\"{1:g}pt\" viewBox=\"0 0 {0:g} {1:g}\" "
      "font-family=\"Helvetica, Arial, sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      width_, height_);
  for (const Item& item : items_) {
    const Point p = item.points[0];
    const std::string style = svg_style(item.style);
    switch (item.kind) {
      case Item::Kind::line: {
        std::vector<std::string> places;
        for (const Point& point : item.points) places.push_back(fmt::format("{:.2f},{:.2f}", point.x, point.y));
        out += fmt::format("<polyline points=\"{}\"{}/>\n", fmt::join(places, " "), style);
        break;
      }
      case Item::Kind::rectangle:
        out += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"{}/>\n", p.x, p.y, item.a,
                           item.b, style);
        break;
      case Item::Kind::circle:
        out += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"{}/>\n", p.x, p.y, item.a, style);
        break;
      case Item::Kind::text: {
        constexpr std::array<std::string_view, 3> kAnchors = {"start", "middle", "end"};
        const std::string turned =
            item.upward ? fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", p.x, p.y) : std::string();
        out += fmt::format(
            "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:g}\" fill=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", p.x, p.y,
            item.a, item.style.fill, kAnchors[static_cast<size_t>(item.anchor)], turned, html_escaped(item.words));
      }
    }
  }
  return out + "</svg>\n";
}

std::string FigureCanvas::pdf() const {
  std::string content = fmt::format("1 0 0 -1 0 {:g} cm\n", height_);  // y is down
  for (const Item& item : items_) {
    const Point p = item.points[0];
    content += pdf_style(item.style);
    switch (item.kind) {
      case Item::Kind::line:
        for (size_t i = 0; i < item.points.size(); ++i) {
          content += fmt::format("{:.2f} {:.2f} {}\n", item.points[i].x, item.points[i].y, i == 0 ? "m" : "l");
        }
        content += "S\n";
        break;
      case Item::Kind::rectangle:
        content += fmt::format("{:.2f} {:.2f} {:.2f} {:.2f} re {}\n", p.x, p.y, item.a, item.b, paint(item.style));
        break;
      case Item::Kind::circle: {
        const double r = item.a, k = 0.5523 * r;  // four cubic arcs
        content += fmt::format(
            "{0:.2f} {2:.2f} m {0:.2f} {3:.2f} {4:.2f} {5:.2f} {1:.2f} {5:.2f} c {6:.2f} {5:.2f} {7:.2f} {3:.2f} "
            "{7:.2f} {2:.2f} c {7:.2f} {8:.2f} {6:.2f} {9:.2f} {1:.2f} {9:.2f} c {4:.2f} {9:.2f} {0:.2f} {8:.2f} "
            "{0:.2f} {2:.2f} c {10}\n",
            p.x + r, p.x, p.y, p.y + k, p.x + k, p.y + r, p.x - k, p.x - r, p.y - k, p.y - r, paint(item.style));
        break;
      }
      case Item::Kind::text: {
        std::string escaped;
        for (const char c : ascii(item.words))
          escaped += c == '(' || c == ')' || c == '\\' ? fmt::format("\\{}", c) : std::string(1, c);
        const double shift = 0.5 * static_cast<double>(item.anchor) * text_width(item.words, item.a);
        const Point at = item.upward ? Point{p.x, p.y + shift} : Point{p.x - shift, p.y};
        content += fmt::format("BT /F1 {:g} Tf {} {:.2f} {:.2f} Tm ({}) Tj ET\n", item.a,
                               item.upward ? "0 -1 -1 0" : "1 0 0 -1", at.x, at.y, escaped);
      }
    }
  }
  const std::array<std::string, 5> objects = {
      "<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
      fmt::format(
          "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:g} {:g}] /Contents 4 0 R /Resources << /Font << /F1 5 0 "
          "R >> >> >>",
          width_, height_),
      fmt::format("<< /Length {} >>\nstream\n{}endstream", content.size(), content),
      "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>"};
  std::string out = "%PDF-1.4\n", table;
  for (size_t i = 0; i < objects.size(); ++i) {
    table += fmt::format("{:010} 00000 n \n", out.size());
    out += fmt::format("{} 0 obj\n{}\nendobj\n", i + 1, objects[i]);
  }
  return out + fmt::format(
                   "xref\n0 {0}\n0000000000 65535 f \n{1}trailer\n<< /Size {0} /Root 1 0 R >>\nstartxref\n{2}\n%%EOF\n",
                   objects.size() + 1, table, out.size());
}

}  // namespace hedgehop::sim
