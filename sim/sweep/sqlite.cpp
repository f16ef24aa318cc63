#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>

#include "sim/config/whole_file.h"
#include "sim/sweep/sweep.h"

namespace hedgehop::sim {
namespace {

struct Close {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, Close>;
using Statement = std::unique_ptr<sqlite3_stmt, Close>;

/// Throws SQLite's message unless the call succeeded.
void expect(bool succeeded, sqlite3* database) {
  if (!succeeded) throw std::runtime_error(sqlite3_errmsg(database));
}

std::string quoted_name(const std::string& name) {
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// Returns a column name that is unique regardless of case, as SQLite requires: a repeated name gets a number.
std::string unique_name(const std::string& name, std::set<std::string>& taken) {
  const auto lower = [](std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  std::string own = name;
  for (int number = 2; !taken.insert(lower(own)).second; ++number) own = fmt::format("{}_{}", name, number);
  return own;
}

/// Unknown numbers and empty words are NULL.
int bind(sqlite3_stmt* statement, int place, const Table::Column& column, size_t row) {
  if (const auto* const words = std::get_if<std::vector<std::string>>(&column.values)) {
    const std::string& text = (*words)[row];
    if (text.empty()) return sqlite3_bind_null(statement, place);
    return sqlite3_bind_text(statement, place, text.data(), static_cast<int>(text.size()), SQLITE_STATIC);
  }
  const double number = std::get<std::vector<double>>(column.values)[row];
  if (std::isnan(number)) return sqlite3_bind_null(statement, place);
  if (column.whole) return sqlite3_bind_int64(statement, place, static_cast<int64_t>(number));
  return sqlite3_bind_double(statement, place, number);
}

/// Returns the file of a database with the table. It is built in memory, because SQLite writes only files with names.
std::string bytes_of(const Table& table) {
  sqlite3* opened = nullptr;
  const int error = sqlite3_open(":memory:", &opened);
  const Database database(opened);
  expect(error == SQLITE_OK, opened);
  expect(sqlite3_exec(opened, "BEGIN", nullptr, nullptr, nullptr) == SQLITE_OK, opened);
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const std::string& name : table.names()) names.push_back(quoted_name(unique_name(name, taken)));
  const std::string create = fmt::format("CREATE TABLE flights ({})", fmt::join(names, ", "));
  expect(sqlite3_exec(opened, create.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK, opened);

  const std::vector<char> places(names.size(), '?');
  const std::string insert = fmt::format("INSERT INTO flights VALUES ({})", fmt::join(places, ","));
  sqlite3_stmt* prepared = nullptr;
  expect(sqlite3_prepare_v2(opened, insert.c_str(), -1, &prepared, nullptr) == SQLITE_OK, opened);
  const Statement statement(prepared);
  for (size_t row = 0; row < table.rows(); ++row) {
    for (size_t i = 0; i < table.columns().size(); ++i) {
      expect(bind(prepared, static_cast<int>(i + 1), table.columns()[i], row) == SQLITE_OK, opened);
    }
    expect(sqlite3_step(prepared) == SQLITE_DONE, opened);
    sqlite3_reset(prepared);
  }
  expect(sqlite3_exec(opened, "COMMIT", nullptr, nullptr, nullptr) == SQLITE_OK, opened);

  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> bytes(sqlite3_serialize(opened, "main", &size, 0),
                                                                      sqlite3_free);
  if (!bytes) throw std::runtime_error(fmt::format("SQLite has no memory for {} rows", table.rows()));
  return {bytes.get(), bytes.get() + size};
}

}  // namespace

void write_sqlite(const std::filesystem::path& file, const Table& table) { write_file_whole(file, bytes_of(table)); }

}  // namespace hedgehop::sim
