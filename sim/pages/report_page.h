#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hedgehop::sim {

/// Text that means itself in HTML, also within quoted attributes.
std::string html_escaped(std::string_view text);
/// JSON text that can stand in a <script> element: no `<`, so neither `</script` nor `<!--`. Reads as the same values.
std::string script_safe(std::string json);
/// Base64 (RFC 4648) with padding.
std::string base64(std::string_view bytes);

/// The film as the page shows it: nothing, a file beside the page, or the bytes of a WebM file inside the page.
struct PageFilm {
  std::string link;  ///< relative
  std::string bytes;
};

/// A whole report: styles, scripts and data in one HTML text.
/// @param title  any text. @param data_json  what the script reads, see report_data().
std::string report_page(std::string_view title, std::string data_json, const PageFilm& film);

/// A whole report of a batch or sweep. @param title  any text. @param data_json  see write_campaign_report().
std::string campaign_page(std::string_view title, std::string data_json);

/// A whole replay of a flight. @param title  any text. @param data_json  see write_replay().
std::string replay_page(std::string_view title, std::string data_json);

/// A whole page of plots of a vehicle's trim over speed. @param title  any text. @param data_json  see trim_data().
std::string trim_page(std::string_view title, std::string data_json);

/// A whole page of papers' figures beside ours. @param title  any text. @param data_json  see reproduction_page().
std::string reproduction_html(std::string_view title, std::string data_json);

}  // namespace hedgehop::sim
