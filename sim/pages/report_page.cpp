#include "sim/pages/report_page.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <utility>

#include "sim/pages/web_assets.h"

namespace hedgehop::sim {
namespace {

using Value = std::pair<std::string_view, std::string_view>;

/// Replaces each placeholder `{{name}}` by its value. Placeholders in values are not replaced.
std::string filled(std::string_view page, std::span<const Value> values) {
  std::string result;
  while (true) {
    const size_t open = page.find("{{");
    result.append(page.substr(0, open));
    if (open == std::string_view::npos) return result;
    const size_t close = page.find("}}", open);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    bool known = false;
    for (const auto& [key, value] : values) {
      if (key != name) continue;
      result.append(value);
      known = true;
    }
    if (!known) throw std::logic_error(fmt::format("unknown placeholder '{}' in a page", name));
    page.remove_prefix(close + 2);
  }
}

std::string joined(std::initializer_list<std::string_view> parts, std::string_view between) {
  return fmt::format("{}", fmt::join(parts, between));
}

/// Returns a page: the HTML of all pages with the parts of this one.
std::string page(std::string_view title, std::string_view body, std::string data_json,
                 std::initializer_list<std::string_view> styles, std::initializer_list<std::string_view> scripts) {
  if (kPage.empty()) throw PagesAbsent();
  const std::string safe_title = html_escaped(title), data = script_safe(std::move(data_json));
  const std::string all_styles = joined(styles, "</style>\n<style>");
  const std::string all_scripts = joined(scripts, "</script>\n<script>");
  const std::array values = {Value{"title", safe_title}, Value{"styles", all_styles}, Value{"body", body},
                             Value{"data", data}, Value{"scripts", all_scripts}};
  return filled(kPage, values);
}

std::string film_element(const PageFilm& film) {
  if (!film.bytes.empty()) {
    return "<video id=\"film\" aria-label=\"camera images\" muted playsinline></video>\n"
           "<script type=\"text/plain\" id=\"film-bytes\">" +
           base64(film.bytes) + "</script>";
  }
  if (film.link.empty()) return "";
  return fmt::format("<video id=\"film\" aria-label=\"camera images\" muted playsinline src=\"{}\"></video>",
                     html_escaped(film.link));
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string script_safe(std::string json) {
  std::string result;
  result.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      result += "\\u003c";  // '<' occurs in strings of JSON only
    } else {
      result += c;
    }
  }
  return result;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [bytes](size_t i) -> uint32_t { return i < bytes.size() ? static_cast<uint8_t>(bytes[i]) : 0; };
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const uint32_t group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (const int shift : {18, 12, 6, 0}) result += kDigits[group >> shift & 63];
  }
  for (size_t pad = (3 - bytes.size() % 3) % 3; pad > 0; --pad) result[result.size() - pad] = '=';
  return result;
}

std::string report_page(std::string_view title, std::string data_json, const PageFilm& film) {
  const std::string film_html = film_element(film);
  const std::array values = {Value{"film", film_html}};
  return page(title, filled(kReportBody, values), std::move(data_json), {kPlotStyle, kReportStyle},
              {kPlotScript, kReportScripts});
}

std::string trim_page(std::string_view title, std::string data_json) {
  return page(title, kTrimBody, std::move(data_json), {kPlotStyle, kReportStyle}, {kPlotScript, kTrimScripts});
}

std::string campaign_page(std::string_view title, std::string data_json) {
  return page(title, kCampaignBody, std::move(data_json), {kReportStyle, kCampaignStyle}, {kCampaignScripts});
}

std::string runs_html(std::string_view title, std::string data_json) {
  return page(title, kRunsBody, std::move(data_json), {kReportStyle, kCampaignStyle}, {kRunsScripts});
}

std::string reproduction_html(std::string_view title, std::string data_json) {
  return page(title, kReproductionBody, std::move(data_json), {kReportStyle, kCampaignStyle}, {kReproductionScripts});
}

std::string replay_page(std::string_view title, std::string data_json) {
  return page(std::string(title) + ", replay", kReplayBody, std::move(data_json),
              {kPlotStyle, kReportStyle, kReplayStyle}, {kPlotScript, kReplayScripts});
}

}  // namespace hedgehop::sim
