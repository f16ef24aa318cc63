#include "sim/record/report_page.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <utility>

#include "sim/record/web_assets.h"

namespace hedgehop::sim {
namespace {

using Value = std::pair<std::string_view, std::string_view>;

/// Puts each value where the template says `{{name}}`; what is put in is not looked at again.
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
    if (!known) throw std::logic_error(fmt::format("a page's template names unknown '{}'", name));
    page.remove_prefix(close + 2);
  }
}

std::string film_element(const PageFilm& film) {
  if (!film.bytes.empty()) {
    return "<video id=\"film\" controls muted playsinline></video>\n"
           "<script type=\"text/plain\" id=\"film-bytes\">" +
           base64(film.bytes) + "</script>";
  }
  if (film.link.empty()) return "";
  return fmt::format("<video id=\"film\" controls muted playsinline src=\"{}\"></video>", html_escaped(film.link));
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
      result += "\\u003c";  // only strings of JSON can hold a '<'
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
  const std::string safe_title = html_escaped(title), data = script_safe(std::move(data_json));
  const std::string film_html = film_element(film);
  const std::array values = {Value{"title", safe_title},
                             Value{"plot_style", kPlotStyle},
                             Value{"style", kReportStyle},
                             Value{"film", film_html},
                             Value{"data", data},
                             Value{"plot_script", kPlotScript},
                             Value{"scripts", kReportScripts}};
  return filled(kReportPage, values);
}

std::string trim_page(std::string_view title, std::string data_json) {
  const std::string safe_title = html_escaped(title), data = script_safe(std::move(data_json));
  const std::array values = {Value{"title", safe_title},        Value{"plot_style", kPlotStyle},
                             Value{"style", kReportStyle},      Value{"data", data},
                             Value{"plot_script", kPlotScript}, Value{"scripts", kTrimScripts}};
  return filled(kTrimPage, values);
}

std::string campaign_page(std::string_view title, std::string data_json) {
  const std::string safe_title = html_escaped(title), data = script_safe(std::move(data_json));
  const std::array values = {Value{"title", safe_title}, Value{"style", kReportStyle},
                             Value{"campaign_style", kCampaignStyle}, Value{"data", data},
                             Value{"scripts", kCampaignScripts}};
  return filled(kCampaignPage, values);
}

std::string reproduction_html(std::string_view title, std::string data_json) {
  const std::string safe_title = html_escaped(title), data = script_safe(std::move(data_json));
  const std::array values = {Value{"title", safe_title}, Value{"style", kReportStyle},
                             Value{"campaign_style", kCampaignStyle}, Value{"data", data},
                             Value{"scripts", kReproductionScripts}};
  return filled(kReproductionPage, values);
}

std::string replay_page(std::string_view title, std::string data_json) {
  const std::string safe_title = html_escaped(title), data = script_safe(std::move(data_json));
  const std::array values = {Value{"title", safe_title}, Value{"style", kReportStyle},
                             Value{"replay_style", kReplayStyle}, Value{"data", data},
                             Value{"scripts", kReplayScripts}};
  return filled(kReplayPage, values);
}

}  // namespace hedgehop::sim
