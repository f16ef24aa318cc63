#include "sim/batch/junit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <utility>

#include "sim/flight/build.h"

namespace hedgehop::sim {
namespace {

using Status = FlightRecord::Status;

/// Text for XML 1.0: markup escaped, what no XML may hold replaced.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\n':
        out += "&#10;";
        break;
      default:
        // Only ASCII is sure to be well formed: a worker's last line may hold any bytes.
        out += static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e ? '?' : c;
    }
  }
  return out;
}

std::string number_words(const nlohmann::ordered_json& value) {
  return value.is_number() ? fmt::format("{:g}", value.get<double>()) : "unknown";
}

/// One test case; what is wrong with it, if anything, is an element of its own.
struct Case {
  std::string name, facts;
  std::string wrong = {};    ///< "failure", "error", "skipped" or nothing
  std::string message = {};  ///< of what is wrong
};

class Suite {
 public:
  Suite(std::string name, double time_s) : name_(std::move(name)), time_s_(time_s) {}

  void add(const Case& c) {
    ++tests_;
    failures_ += c.wrong == "failure" ? 1 : 0;
    errors_ += c.wrong == "error" ? 1 : 0;
    skipped_ += c.wrong == "skipped" ? 1 : 0;
    fmt::format_to(std::back_inserter(cases_), "    <testcase classname=\"{}\" name=\"{}\" time=\"{}\">\n",
                   escaped(name_), escaped(c.name), tests_ == 1 ? time_s_ : 0.0);
    if (!c.wrong.empty()) {
      fmt::format_to(std::back_inserter(cases_), "      <{} message=\"{}\"/>\n", c.wrong, escaped(c.message));
    }
    fmt::format_to(std::back_inserter(cases_), "      <system-out>{}</system-out>\n    </testcase>\n",
                   escaped(c.facts));
  }
  std::string text() const {
    return fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{}\">\n{}{}  "
        "</testsuite>\n",
        escaped(name_), tests_, failures_, errors_, skipped_, time_s_, properties_text(), cases_);
  }
  /// A fact about the whole suite; none when the value is empty.
  void set(std::string name, std::string value) {
    if (!value.empty()) properties_.emplace_back(std::move(name), std::move(value));
  }
  int tests() const { return tests_; }
  int failures() const { return failures_; }
  int errors() const { return errors_; }
  int skipped() const { return skipped_; }

 private:
  std::string properties_text() const {
    std::string text;
    for (const auto& [name, value] : properties_) {
      text += fmt::format("      <property name=\"{}\" value=\"{}\"/>\n", escaped(name), escaped(value));
    }
    return text.empty() ? "" : "    <properties>\n" + text + "    </properties>\n";
  }

  std::string name_;
  double time_s_;
  std::vector<std::pair<std::string, std::string>> properties_;
  int tests_ = 0, failures_ = 0, errors_ = 0, skipped_ = 0;
  std::string cases_;
};

Suite flight_suite(const FlightRecord& record, bool binding) {
  const bool flown = record.status == Status::flown;
  Suite suite(record.order.id, flown ? record.result.value("wall_s", 0.0) : 0.0);
  const std::string again = "again: " + rerun_command(record.order);
  const std::string cause = flown ? record.result.value("cause", "") : "";
  const std::string because = cause.empty() ? "" : fmt::format(" ({})", cause);
  Case flight{.name = "flight", .facts = fmt::format("{}{}\n{}", outcome_words(record), because, again)};
  if (record.status == Status::failed) {
    flight.wrong = "error";
    flight.message = record.cause;
  } else if (record.status == Status::missing) {
    flight.wrong = "skipped";
    flight.message = "not flown: the campaign was interrupted";
  } else if (record.result.at("outcome") == "fault") {
    flight.wrong = "error";
    flight.message = cause;
  } else if (unchecked(record)) {
    flight.wrong = "skipped";
    flight.message = kNoChecks;
  }
  suite.set("build", build_of(record));
  suite.set("truth_used", fmt::format("{}", fmt::join(truth_used(record), "; ")));
  suite.add(flight);
  if (!flown) return suite;
  for (const auto& check : record.result.at("checks")) {
    const std::string unit = check.at("unit").get<std::string>();
    const std::string moment = check.contains("t_s") && check["t_s"].is_number()
                                   ? fmt::format(" at {:.2f} s", check["t_s"].get<double>())
                                   : "";
    const std::string measured = fmt::format("{} {}{}, must be {} {} {}", number_words(check.at("value")), unit, moment,
                                             check.value("must", "<="), number_words(check.at("limit")), unit);
    Case one{.name = check.at("name").get<std::string>(), .facts = measured + "\n" + again};
    if (!check.at("passed").get<bool>()) {
      one.wrong = binding ? "failure" : "skipped";
      one.message = measured + because + (binding ? "" : "; fails, which counts over the seeds");
    }
    suite.add(one);
  }
  return suite;
}

}  // namespace

std::string junit_text(const std::vector<FlightRecord>& records, const std::vector<GroupVerdict>& verdicts) {
  std::vector<Suite> suites;
  for (const FlightRecord& record : records) suites.push_back(flight_suite(record, verdicts.empty()));
  if (!verdicts.empty()) {
    Suite& over_seeds = suites.emplace_back("over the seeds", 0.0);
    over_seeds.set("build", std::string(build_identity()));
    for (const GroupVerdict& verdict : verdicts) {
      over_seeds.add({.name = verdict.check + " " + verdict.group,
                      .facts = verdict.words,
                      .wrong = verdict.passed ? "" : "failure",
                      .message = verdict.words});
    }
  }
  int tests = 0, failures = 0, errors = 0, skipped = 0;
  std::string body;
  for (const Suite& suite : suites) {
    tests += suite.tests();
    failures += suite.failures();
    errors += suite.errors();
    skipped += suite.skipped();
    body += suite.text();
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"hedgehop\" tests=\"{}\" failures=\"{}\" "
      "errors=\"{}\" skipped=\"{}\">\n{}</testsuites>\n",
      tests, failures, errors, skipped, body);
}

}  // namespace hedgehop::sim
