#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/config/input_error.h"

namespace hedgehop::sim {

/// Thrown for a page if Hedgehop was built without npm.
class PagesAbsent : public InputError {
 public:
  PagesAbsent()
      : InputError("no page was written: this build of Hedgehop has no pages (hedgehop --version --features)") {}
};

/// Returns text escaped for HTML, also for quoted attributes.
std::string html_escaped(std::string_view text);
/// Returns JSON for a <script> element: equal values without `<`, thus without `</script` and `<!--`.
std::string script_safe(std::string json);
/// Returns Base64 (RFC 4648) with padding.
std::string base64(std::string_view bytes);

/// The film of a page: none, a link to a file, or the bytes of a WebM file embedded in the page.
struct PageFilm {
  std::string link;  ///< relative
  std::string bytes;
};

// Each function returns a page as one HTML text with styles, scripts and data, and throws PagesAbsent.

/// The report of a run. @param title  any text. @param data_json  of report_data().
std::string report_page(std::string_view title, std::string data_json, const PageFilm& film);

/// The report of a batch or sweep. @param title  any text. @param data_json  see write_campaign_report().
std::string campaign_page(std::string_view title, std::string data_json);

/// The replay of a flight. @param title  any text. @param data_json  see write_replay().
std::string replay_page(std::string_view title, std::string data_json);

/// Plots of the trim of a vehicle over speed. @param title  any text. @param data_json  of trim_data().
std::string trim_page(std::string_view title, std::string data_json);

/// The index of all results in a folder tree. @param title  any text. @param data_json  of runs_data().
std::string runs_html(std::string_view title, std::string data_json);

/// The results compared with the papers. @param title  any text. @param data_json  see reproduction_page().
std::string reproduction_html(std::string_view title, std::string data_json);

}  // namespace hedgehop::sim
