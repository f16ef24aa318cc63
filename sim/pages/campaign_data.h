#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "sim/batch/flight_table.h"
#include "sim/batch/group_verdict.h"

namespace hedgehop::sim {

/// Information on a flight that is only in the folder of the flight.
struct FlightNotes {
  std::string why;                           ///< failure_words() of its result
  std::map<std::string, std::string> units;  ///< of columns `metric.NAME` and `check.NAME`
  std::string first_failed;  ///< name of the check that failed first, else the outcome; empty if all hold
  bool has_report = false, has_replay = false;
};
/// Returns the notes of all records. @param folder  of the campaign.
std::vector<FlightNotes> read_notes(const std::filesystem::path& folder, const std::vector<FlightRecord>& records);

/// Returns the unit of a column of a table or of a key of a scenario, such as "wind.speed"; empty if it is unknown.
std::string unit_of_column(const std::string& name, const std::vector<FlightNotes>& notes);

/// Returns the table for the page, column by column: `columns` of {name, unit, is_text, values}. Numbers have six
/// significant figures; empty fields and values that are not finite are null. Seeds are texts, because a number of a
/// page is exact up to 2^53 only. Empty columns are omitted.
nlohmann::ordered_json columns_data(const Table& table, const std::vector<FlightNotes>& notes);

/// Returns the film strips of the flights: `images` of [row, JPEG in base64], in the order of the rows, up to 2.5 MB in
/// total, and `omitted`, the number of strips beyond that.
/// @param folder  of the campaign.
nlohmann::ordered_json strips_data(const std::filesystem::path& folder, const std::vector<FlightRecord>& records);

/// Returns the names of the columns that a sweep varied: those between the number of the point and the status.
std::vector<std::string> swept_columns(const FlightList& flights);

/// Returns the flights as one group, "all flights". @param without  groups that do not count: those of a control.
GroupSummary all_flights(std::vector<FlightRecord> records, const std::set<std::string>& without = {});

/// Returns one row for all flights, then one row with a 95 % interval per group of flights that differ in the seed
/// only. The row for all flights excludes the groups of a leaderboard's control.
/// @param anytime  whether the intervals are valid at any time, for flights with a stopping rule; else Wilson
/// intervals.
nlohmann::ordered_json groups_data(const std::vector<FlightRecord>& records, bool anytime,
                                   const std::set<std::string>& controls = {});

}  // namespace hedgehop::sim
