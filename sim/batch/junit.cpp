#include "sim/batch/junit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <string_view>

#include "sim/batch/xml_text.h"
#include "sim/flight/build.h"
#include "sim/flight/words.h"

namespace hedgehop::sim {
namespace {

void set(pugi::xml_node node, const char* name, std::string_view value) {
  node.append_attribute(name).set_value(xml_text(value).c_str());
}
void set(pugi::xml_node node, const char* name, int value) { node.append_attribute(name).set_value(value); }

/// Jenkins' XSD permits three decimals and no exponent.
void set_time(pugi::xml_node node, double time_s) {
  set(node, "time", fmt::format("{:.3f}", std::isfinite(time_s) ? std::max(0.0, time_s) : 0.0));
}

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
  }
};

/// One test case. If it did not pass, an element of its own says so.
struct Case {
  std::string name, facts;
  std::string wrong = {};        ///< "failure", "error", "skipped" or ""
  std::string type = {};         ///< of the element
  std::string message = {};      ///< of the element, one line
  bool is_complete = false;      ///< whether the facts contain the message; otherwise the body has both
  std::string attachments = {};  ///< lines of system-out only
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
};

/// Returns the names of the cases. Equal names get numbers, because GitLab keeps only the first case of a name.
std::vector<std::string> distinct_names(const std::vector<Case>& cases) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const Case& one : cases) {
    std::string name = one.name;
    for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{} ({})", one.name, i);
    names.push_back(std::move(name));
  }
  return names;
}

void write_case(pugi::xml_node suite, const std::string& suite_name, const std::string& name, const Case& c,
                double time_s) {
  pugi::xml_node node = suite.append_child("testcase");
  set(node, "classname", suite_name);
  set(node, "name", name);
  set_time(node, time_s);
  if (!c.wrong.empty()) {
    pugi::xml_node wrong = node.append_child(c.wrong.c_str());
    set(wrong, "type", c.type);
    set(wrong, "message", c.message);
    const bool complete = c.is_complete || c.facts.find(c.message) != std::string::npos;
    wrong.text().set(xml_text(complete ? c.facts : c.message + "\n" + c.facts).c_str());
  }
  node.append_child("system-out").text().set(xml_text(c.facts + c.attachments).c_str());
}

void write_suite(pugi::xml_node parent, const Suite& suite, const JUnitOrigin& origin) {
  pugi::xml_node node = parent.append_child("testsuite");
  const CaseCounts counts = suite.counts();
  set(node, "name", suite.name);
  counts.write(node);
  set(node, "skipped", counts.skipped);
  set_time(node, suite.time_s);
  set(node, "timestamp", origin.timestamp);
  set(node, "hostname", origin.hostname);
  pugi::xml_node list = node.append_child("properties");
  for (const auto& [key, value] : suite.properties) {
    if (value.empty()) continue;
    pugi::xml_node property = list.append_child("property");
    set(property, "name", key);
    set(property, "value", value);
  }
  const std::vector<std::string> names = distinct_names(suite.cases);
  for (size_t i = 0; i < names.size(); ++i) {
    write_case(node, suite.name, names[i], suite.cases[i], i == 0 ? suite.time_s : 0.0);
  }
}

std::string text_of(const std::vector<Suite>& suites, const JUnitOrigin& origin) {
  CaseCounts all;
  double time_s = 0.0;
  for (const Suite& suite : suites) {
    all.add(suite.counts());
    time_s += suite.time_s;
  }
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  set(declaration, "version", "1.0");
  set(declaration, "encoding", "UTF-8");
  pugi::xml_node root = document.append_child("testsuites");
  set(root, "name", "hedgehop");
  all.write(root);  // without `skipped`, which Jenkins' XSD refuses here
  set_time(root, time_s);
  for (const Suite& suite : suites) write_suite(root, suite, origin);
  std::ostringstream text;
  document.save(text, "  ", pugi::format_default, pugi::encoding_utf8);
  return text.str();
}

Case flight_case(const FlightRecord& record, const std::string& facts) {
  Case flight{.name = "flight", .facts = facts};
  switch (verdict_of(record)) {
    case Verdict::not_flown: {
      const bool failed = record.status == FlightRecord::Status::failed;
      flight.wrong = failed ? "error" : "skipped";
      flight.type = !failed ? "interrupted" : record.order.fault.empty() ? "no_result" : "bad_input";
      flight.message = failed ? record.cause : "not flown: the campaign was interrupted";
      break;
    }
    case Verdict::fault:
      flight.wrong = "error";
      flight.type = "fault";
      flight.message = record.result->flight.cause;
      break;
    case Verdict::unchecked:
      flight.wrong = "skipped";
      flight.type = "no_checks";
      flight.message = kNoChecks;
      break;
    case Verdict::passed:
    case Verdict::failed:
      break;
  }
  return flight;
}

/// Whether the cause of a flight is more than its first failed check.
bool is_cause_of_flight(const FlightResult& result) {
  return result.outcome != Outcome::reached && (result.outcome != Outcome::timeout || result.goal_distance_m);
}

/// @param flight  outcome and cause of the flight, if it ended before its goal; else "".
Case check_case(const CheckResult& check, const std::string& flight, const std::string& again, bool binding) {
  const std::string measured = check_words(check);
  Case one{.name = check.name, .facts = measured + "\n" + again};
  if (check.passed) return one;
  one.wrong = binding ? "failure" : "skipped";
  one.type = binding ? "failed_check" : "failed_check_of_a_seed";
  one.message = measured + (flight.empty() ? "" : fmt::format(" ({})", flight)) +
                (binding ? "" : "; fails, which counts over the seeds");
  one.facts = measured + (flight.empty() ? "" : "\nflight: " + flight) + "\n" + again;
  one.is_complete = true;
  return one;
}

/// Attaches files to each failed case, because GitLab reads those of a failed case only, and of each the first one.
void attach(std::vector<Case>& cases, const std::vector<std::string>& files) {
  std::string lines;
  for (const std::string& file : files) lines += fmt::format("\n[[ATTACHMENT|{}]]", file);
  const auto failed = [](const Case& c) { return c.wrong == "failure" || c.wrong == "error"; };
  const bool any = std::ranges::any_of(cases, failed);
  for (Case& one : cases) one.attachments = failed(one) ? lines : "";
  if (!any) cases.front().attachments = lines;  // checks over the seeds decide
}

Suite flight_suite(const FlightRecord& record, bool binding, const Attachments& attachments) {
  const Order& order = record.order;
  const std::string again = "re-run: " + rerun_command(order);
  const std::string cause = record.result ? record.result->flight.cause : "";
  const std::string because = cause.empty() ? "" : fmt::format(" ({})", cause);
  const bool of_flight = record.result && is_cause_of_flight(record.result->flight);
  Suite suite{.name = order.id, .time_s = record.result ? record.result->flight.wall_s : 0.0};
  suite.properties = {{"scenario", order.scenario.string()},
                      {"group", order.group},
                      {"seed", order.fault.empty() ? std::to_string(order.seed) : ""},
                      {"build", build_of(record)},
                      {"truth_used", fmt::format("{}", fmt::join(truth_used(record), "; "))},
                      {"command", rerun_command(order)}};
  if (record.result) {
    suite.properties.emplace_back("version", record.result->info.version);
    suite.properties.emplace_back("renderer", renderer_words(record.result->flight.libraries));
    suite.properties.emplace_back("libraries", library_words(record.result->flight.libraries));
  }
  std::string facts = fmt::format("{}{}\n{}", shown_outcome(record), because, again);
  if (!order.fault.empty()) facts = fmt::format("{}\n{}", order.fault, fmt::join(order.more_faults, "\n"));
  if (record.result && record.result->flight.goal_missed_unchecked)
    facts += fmt::format("\nwarning: {}", kGoalMissedUnchecked);
  suite.cases.push_back(flight_case(record, facts));
  if (!record.result) return suite;
  for (const CheckResult& check : record.result->flight.checks) {
    suite.cases.push_back(check_case(check, of_flight ? cause : "", again, binding));
  }
  if (const auto files = attachments.find(order.id); files != attachments.end()) attach(suite.cases, files->second);
  return suite;
}

}  // namespace

JUnitOrigin junit_origin() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  std::array<char, 32> stamp{};
  std::strftime(stamp.data(), stamp.size(), "%Y-%m-%dT%H:%M:%S", &utc);
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return {stamp.data(), host.data()};
}

std::string junit_text(const std::vector<FlightRecord>& records, const std::vector<GroupVerdict>& verdicts,
                       const JUnitOrigin& origin, const Attachments& attachments) {
  std::vector<Suite> suites;
  for (const FlightRecord& record : records) suites.push_back(flight_suite(record, verdicts.empty(), attachments));
  if (!verdicts.empty()) {
    Suite& over_seeds = suites.emplace_back(Suite{.name = "over the seeds"});
    over_seeds.properties = {{"build", std::string(build_identity())}};
    for (const GroupVerdict& verdict : verdicts) {
      over_seeds.cases.push_back({.name = verdict.check + " " + verdict.group,
                                  .facts = verdict.words,
                                  .wrong = verdict.passed ? "" : "failure",
                                  .type = "failed_over_the_seeds",
                                  .message = verdict.words});
    }
  }
  return text_of(suites, origin);
}

std::string junit_of_bad_input(const std::vector<std::string>& faults, const JUnitOrigin& origin) {
  Suite suite{.name = "input"};
  suite.properties = {{"build", std::string(build_identity())}};
  if (faults.empty()) suite.cases.push_back({.name = "valid", .facts = "every file is valid"});
  for (const std::string& fault : faults) {
    suite.cases.push_back({.name = fault, .facts = fault, .wrong = "error", .type = "bad_input", .message = fault});
  }
  return text_of({suite}, origin);
}

}  // namespace hedgehop::sim
