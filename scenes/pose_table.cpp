#include "scenes/pose_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/fields/bounds.h"
#include "sim/fields/file_fault.h"
#include "sim/fields/utf8_mark.h"

namespace hedgehop::scenes {
namespace {

constexpr size_t kColumns = 8;

[[noreturn]] void refuse(int line, const std::string& fault) {
  throw std::invalid_argument("line " + std::to_string(line) + ": " + fault);
}

double parse_cell(std::string_view cell, int line) {
  const size_t first = cell.find_first_not_of(" \t"), last = cell.find_last_not_of(" \t\r");
  cell = first == std::string_view::npos ? std::string_view() : cell.substr(first, last - first + 1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
    refuse(line, "expected a number, got '" + std::string(cell) + "'");
  return value;
}

/// The map from axes north, west, up to north, east, down is half a turn about north.
PoseRow row_of(const std::array<double, kColumns>& cells, int line) {
  constexpr double kMaxError = 0.01;
  const auto& [t_s, x_m, y_m, z_m, qw, qx, qy, qz] = cells;
  const Eigen::Quaterniond q_WM(qw, qx, -qy, -qz);
  if (std::abs(q_WM.norm() - 1.0) > kMaxError)
    refuse(line, "the quaternion has length " + std::to_string(q_WM.norm()) + "; valid: 1");
  return {t_s, {x_m, -y_m, -z_m}, q_WM.normalized()};
}

std::vector<PoseRow>::const_iterator interval_at(const std::vector<PoseRow>& rows, double t_s) {
  return std::ranges::upper_bound(rows, t_s, {}, &PoseRow::t_s);
}

}  // namespace

PoseTable::PoseTable(std::vector<PoseRow> rows) : rows_(std::move(rows)) {
  if (rows_.empty()) throw std::invalid_argument("it has no rows; valid: at least one");
  const double first_s = rows_.front().t_s;
  for (PoseRow& row : rows_) row.t_s -= first_s;
  for (size_t i = 1; i < rows_.size(); ++i) {
    if (!(rows_[i].t_s > rows_[i - 1].t_s))
      throw std::invalid_argument("row " + std::to_string(i + 1) +
                                  ": its time is not later than that of the row before");
  }
}

PoseRow PoseTable::at(double t_s) const {
  const auto after = interval_at(rows_, t_s);
  if (after == rows_.begin()) return rows_.front();
  if (after == rows_.end()) return rows_.back();
  const PoseRow& before = *(after - 1);
  const double share = (t_s - before.t_s) / (after->t_s - before.t_s);
  return {t_s, before.p_WM + share * (after->p_WM - before.p_WM), before.q_WM.slerp(share, after->q_WM)};
}

PoseTable::Rates PoseTable::rates(double t_s) const {
  const auto after = interval_at(rows_, t_s);
  if (after == rows_.begin() || after == rows_.end()) return {};
  const PoseRow& before = *(after - 1);
  const double dt_s = after->t_s - before.t_s;
  return {(after->p_WM - before.p_WM) / dt_s, before.q_WM.angularDistance(after->q_WM) / dt_s};
}

PoseTable parse_pose_table(std::string_view text) {
  std::vector<PoseRow> rows;
  text = without_utf8_mark(text);
  int line = 0, line_before = 0;  // of the row before
  while (!text.empty()) {
    std::string_view row = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), row.size() + 1));
    ++line;
    if (row.find_first_not_of(" \t\r") == std::string_view::npos || row.starts_with('#')) continue;
    std::array<double, kColumns> cells{};
    const auto commas = static_cast<size_t>(std::ranges::count(row, ','));
    if (commas + 1 != kColumns)
      refuse(line, "expected 8 values (t, x, y, z, qw, qx, qy, qz), got " + std::to_string(commas + 1));
    for (double& cell : cells) {
      const std::string_view here = row.substr(0, row.find(','));
      cell = parse_cell(here, line);
      row.remove_prefix(std::min(row.size(), here.size() + 1));
    }
    rows.push_back(row_of(cells, line));
    if (line_before > 0 && !(rows.back().t_s > rows[rows.size() - 2].t_s)) {
      refuse(line, "the time " + fields::decimal(rows.back().t_s) + " s is not after that of line " +
                       std::to_string(line_before));
    }
    line_before = line;
  }
  return PoseTable(std::move(rows));
}

PoseTable read_pose_table(const std::filesystem::path& file) {
  if (const std::string fault = file_fault(file); !fault.empty()) throw std::invalid_argument(fault);
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return parse_pose_table(text.view());
}

}  // namespace hedgehop::scenes
