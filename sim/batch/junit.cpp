#include "sim/batch/junit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>

#include "sim/flight/build.h"

namespace hedgehop::sim {
namespace {

/// Text that every XML 1.0 parser accepts: a worker's last line may hold any bytes. Line breaks stay.
std::string printable(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool ascii = static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) <= 0x7e;
    out += ascii || c == '\n' ? c : '?';
  }
  return out;
}

void set(pugi::xml_node node, const char* name, std::string_view value) {
  node.append_attribute(name).set_value(printable(value).c_str());
}
void set(pugi::xml_node node, const char* name, int value) { node.append_attribute(name).set_value(value); }

std::string number_words(double value) { return std::isfinite(value) ? fmt::format("{:g}", value) : "unknown"; }

/// Results of test cases.
struct CaseCounts {
  int tests = 0, failures = 0, errors = 0, skipped = 0;

  void add(const CaseCounts& more) {
    tests += more.tests;
    failures += more.failures;
    errors += more.errors;
    skipped += more.skipped;
  }
  void write(pugi::xml_node node) const {
    set(node, "tests", tests);
    set(node, "failures", failures);
    set(node, "errors", errors);
    set(node, "skipped", skipped);
  }
};

/// One test case. If it did not pass, an element of its own says so.
struct Case {
  std::string name, facts;
  std::string wrong = {};    ///< "failure", "error", "skipped" or ""
  std::string message = {};  ///< of the element
};

struct Suite {
  std::string name;
  double time_s = 0.0;
  std::vector<std::pair<const char*, std::string>> properties = {};  ///< without a value: not written
  std::vector<Case> cases = {};

  CaseCounts counts() const {
    CaseCounts counts;
    for (const Case& c : cases) {
      ++counts.tests;
      counts.failures += c.wrong == "failure" ? 1 : 0;
      counts.errors += c.wrong == "error" ? 1 : 0;
      counts.skipped += c.wrong == "skipped" ? 1 : 0;
    }
    return counts;
  }
  void write(pugi::xml_node parent) const {
    pugi::xml_node suite = parent.append_child("testsuite");
    set(suite, "name", name);
    counts().write(suite);
    set(suite, "time", fmt::format("{}", time_s));
    pugi::xml_node list;
    for (const auto& [key, value] : properties) {
      if (value.empty()) continue;
      if (!list) list = suite.append_child("properties");
      pugi::xml_node property = list.append_child("property");
      set(property, "name", key);
      set(property, "value", value);
    }
    for (const Case& c : cases) {
      pugi::xml_node node = suite.append_child("testcase");
      set(node, "classname", name);
      set(node, "name", c.name);
      set(node, "time", fmt::format("{}", &c == &cases.front() ? time_s : 0.0));
      if (!c.wrong.empty()) set(node.append_child(c.wrong.c_str()), "message", c.message);
      node.append_child("system-out").text().set(printable(c.facts).c_str());
    }
  }
};

Case flight_case(const FlightRecord& record, const std::string& because, const std::string& again) {
  Case flight{.name = "flight", .facts = fmt::format("{}{}\n{}", outcome_words(record), because, again)};
  switch (verdict_of(record)) {
    case Verdict::not_flown:
      flight.wrong = record.status == FlightRecord::Status::failed ? "error" : "skipped";
      flight.message =
          record.status == FlightRecord::Status::failed ? record.cause : "not flown: the campaign was interrupted";
      break;
    case Verdict::fault:
      flight.wrong = "error";
      flight.message = record.result->flight.cause;
      break;
    case Verdict::unchecked:
      flight.wrong = "skipped";
      flight.message = kNoChecks;
      break;
    case Verdict::passed:
    case Verdict::failed:
      break;
  }
  return flight;
}

Suite flight_suite(const FlightRecord& record, bool binding) {
  const std::string again = "re-run: " + rerun_command(record.order);
  const std::string cause = record.result ? record.result->flight.cause : "";
  const std::string because = cause.empty() ? "" : fmt::format(" ({})", cause);
  Suite suite{.name = record.order.id, .time_s = record.result ? record.result->flight.wall_s : 0.0};
  suite.properties = {{"build", build_of(record)},
                      {"truth_used", fmt::format("{}", fmt::join(truth_used(record), "; "))}};
  suite.cases.push_back(flight_case(record, because, again));
  if (!record.result) return suite;
  for (const CheckResult& check : record.result->flight.checks) {
    const std::string moment = check.t_s ? fmt::format(" at {:.2f} s", *check.t_s) : "";
    const std::string measured = fmt::format("{} {}{}, must be {} {} {}", number_words(check.value), check.unit, moment,
                                             check.must, number_words(check.limit), check.unit);
    Case one{.name = check.name, .facts = measured + "\n" + again};
    if (!check.passed) {
      one.wrong = binding ? "failure" : "skipped";
      one.message = measured + because + (binding ? "" : "; fails, which counts over the seeds");
    }
    suite.cases.push_back(one);
  }
  return suite;
}

}  // namespace

std::string junit_text(const std::vector<FlightRecord>& records, const std::vector<GroupVerdict>& verdicts) {
  std::vector<Suite> suites;
  for (const FlightRecord& record : records) suites.push_back(flight_suite(record, verdicts.empty()));
  if (!verdicts.empty()) {
    Suite& over_seeds = suites.emplace_back(Suite{.name = "over the seeds"});
    over_seeds.properties = {{"build", std::string(build_identity())}};
    for (const GroupVerdict& verdict : verdicts) {
      over_seeds.cases.push_back({.name = verdict.check + " " + verdict.group,
                                  .facts = verdict.words,
                                  .wrong = verdict.passed ? "" : "failure",
                                  .message = verdict.words});
    }
  }
  CaseCounts all;
  for (const Suite& suite : suites) all.add(suite.counts());
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  set(declaration, "version", "1.0");
  set(declaration, "encoding", "UTF-8");
  pugi::xml_node root = document.append_child("testsuites");
  set(root, "name", "hedgehop");
  all.write(root);
  for (const Suite& suite : suites) suite.write(root);
  std::ostringstream text;
  document.save(text, "  ", pugi::format_default, pugi::encoding_utf8);
  return text.str();
}

}  // namespace hedgehop::sim
