#include "sim/reproduce/paper.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "sim/record/whole_file.h"
#include "sim/reproduce/calculations.h"
#include "sim/reproduce/outcome.h"
#include "sim/scenario/input_error.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

const std::filesystem::path kPapers = HEDGEHOP_SOURCE_DIR "/configs/papers";

std::vector<std::string> faults_of(const std::string& text) {
  const TemporaryFolder folder;
  write_file_whole(folder.path() / "paper.yaml", "title: A\nsource: B\n" + text);
  try {
    read_paper(folder.path() / "paper.yaml");
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

TEST(PaperFile, EveryShippedOneCanBeFlown) {
  int papers = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kPapers)) {
    const Paper paper = read_paper(entry.path());
    std::set<std::string> all, quick;
    for (const Order& order : paper_orders(paper, false)) EXPECT_TRUE(all.insert(order.id).second) << order.id;
    for (const Order& order : paper_orders(paper, true)) quick.insert(order.id);
    EXPECT_TRUE(std::ranges::includes(all, quick)) << paper.key << ": a quick look must be part of the whole";
    ++papers;
  }
  EXPECT_GE(papers, 2);
}

TEST(PaperFile, SourcesStandInTheReferences) {
  const std::string references = read_file_whole(HEDGEHOP_SOURCE_DIR "/REFERENCES.md");
  for (const auto& entry : std::filesystem::directory_iterator(kPapers)) {
    EXPECT_THAT(references, HasSubstr("[" + read_paper(entry.path()).source + "]"));
  }
}

TEST(PaperFile, NamesNobodyHasAreRefusedWithTheirPlace) {
  const std::string flights = "flights: [{scenario: a.yaml, seeds: '1:2'}]\n";
  EXPECT_THAT(faults_of(flights + "rows: [{what: w, flights: [b], column: outcome, is: x, statistic: count}]"),
              Contains(AllOf(HasSubstr("paper.yaml:4"), HasSubstr("no flights are called 'b'"))));
  EXPECT_THAT(faults_of("rows: [{what: w, calculation: none, value: x}]"), Contains(HasSubstr("section_costs")));
  EXPECT_THAT(faults_of("rows: [{what: w, calculation: section_costs, value: x}]"), Contains(HasSubstr("cost_ms")));
  EXPECT_THAT(faults_of("charts: [{title: t, series: [{from: log, label: l, flights: c, y: d}]}]"),
              Contains(HasSubstr("no flights are called 'c'")));
}

TEST(PaperFile, WhatCannotBeMeantIsRefused) {
  const std::string flights = "flights: [{scenario: a.yaml, seeds: '1:2'}]\n";
  EXPECT_THAT(faults_of("rows: [{what: w}]"), Contains(HasSubstr("either 'flights' or 'calculation'")));
  EXPECT_THAT(faults_of("flights: [{scenario: a.yaml, seeds: '2:1'}]"), Contains(HasSubstr("2:1")));
  EXPECT_THAT(faults_of("flights: [{scenario: a.yaml, seeds: '1'}, {scenario: a.yaml, seeds: '2'}]"),
              Contains(HasSubstr("two flights are called 'a'")));
  EXPECT_THAT(faults_of(flights + "rows: [{what: w, flights: [a], column: outcome, statistic: count}]"),
              Contains(HasSubstr("needs 'is'")));
  EXPECT_THAT(faults_of("charts: [{title: t, series: [{from: points, label: l, x: [1, 2], y: [1]}]}]"),
              Contains(HasSubstr("2 places across, but 1 up")));
  EXPECT_THAT(faults_of(flights + "charts: [{title: t, series: [{from: paths, label: l, flights: a}, "
                                  "{from: points, label: p, x: [], y: []}]}]"),
              Contains(HasSubstr("cannot share a chart")));
}

TEST(Calculations, TellTheColumnsTheyPromiseAllOfOneLength) {
  for (const Calculation& calculation : calculations()) {
    const Columns columns = calculation.calculate();
    EXPECT_EQ(columns.size(), calculation.columns.size()) << calculation.name;
    for (const std::string& name : calculation.columns) {
      ASSERT_TRUE(columns.contains(name)) << calculation.name << " " << name;
      EXPECT_EQ(columns.at(name).size(), columns.begin()->second.size()) << calculation.name << " " << name;
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim
