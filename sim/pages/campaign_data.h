#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/batch/flight_table.h"

namespace hedgehop::sim {

/// What only a flight's own folder holds.
struct FlightNotes {
  std::string why;                           ///< failure_words() of its result
  std::map<std::string, std::string> units;  ///< of columns `metric.NAME` and `check.NAME`
  bool has_report = false, has_replay = false;
};
/// @param folder  of the campaign.
std::vector<FlightNotes> read_notes(const std::filesystem::path& folder, const std::vector<FlightRecord>& records);

/// The table as the page reads it, column by column: `columns` of {name, unit, is_text, values}; numbers to six
/// figures, null where the field is empty or not finite. Columns without any value are left out.
nlohmann::ordered_json columns_data(const CsvTable& table, const std::vector<FlightNotes>& notes);

/// Film strips that lie in the flights' folders, as [row, JPEG in base64], the files of the first rows until they make
/// up 2.5 MB. @param folder  of the campaign.
nlohmann::ordered_json strips_data(const std::filesystem::path& folder, const std::vector<FlightRecord>& records);

/// Names of the columns that a sweep varied: those between the number of the point and the status.
std::vector<std::string> swept_columns(const FlightList& flights);

/// Flights that differ by the seed alone, one row a group with its interval (95 %), and before them one of all.
/// @param anytime  intervals that hold at any time, for flights under a stopping rule; else Wilson's.
nlohmann::ordered_json groups_data(const std::vector<FlightRecord>& records, bool anytime);

/// What an earlier campaign's flights did: `flights` (one a row of `now`, null where there was none), `groups` of the
/// same name with both rates and the interval (95 %) of the rate's change, and the ids of flights that exist no longer.
/// Flights correspond by their id, else by scenario and seed where these are unique, so that settings can be compared.
nlohmann::ordered_json against_data(const FlightList& now, const FlightList& before);

}  // namespace hedgehop::sim
