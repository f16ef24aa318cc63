#include "sim/record/flight_columns.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hedgehop::sim {
namespace {

/// Builds the columns of a list of rows.
template <class Row>
class Columns {
 public:
  explicit Columns(const std::vector<Row>& rows) : rows_(rows) {}

  template <class Value>
  void add(std::string name, Value value) {
    std::vector<double> numbers;
    numbers.reserve(rows_.size());
    for (const Row& row : rows_) numbers.push_back(value(row));
    table_.add(std::move(name), std::move(numbers));
  }
  void add(std::string name, double Row::*number) {
    add(std::move(name), [number](const Row& row) { return row.*number; });
  }
  void add(std::string name, std::optional<double> Row::*number) {
    add(std::move(name), [number](const Row& row) { return (row.*number).value_or(NAN); });
  }
  void add(const std::array<const char*, 3>& names, Eigen::Vector3d Row::*vector) {
    for (int i = 0; i < 3; ++i) {
      add(names[static_cast<size_t>(i)], [vector, i](const Row& row) { return (row.*vector)[i]; });
    }
  }
  void add(const std::array<const char*, 2>& names, std::optional<Eigen::Vector2d> Row::*vector) {
    for (int i = 0; i < 2; ++i) {
      add(names[static_cast<size_t>(i)],
          [vector, i](const Row& row) { return row.*vector ? (*(row.*vector))[i] : NAN; });
    }
  }
  void add_words(std::string name, std::string Row::*word) {
    std::vector<std::string> words;
    for (const Row& row : rows_) words.push_back(row.*word);
    table_.add(std::move(name), std::move(words));
  }
  Table take() { return std::move(table_); }

 private:
  const std::vector<Row>& rows_;
  Table table_;
};

template <class Row>
void add_command(Columns<Row>& columns) {
  columns.add({"cmd_v_north_mps", "cmd_v_east_mps"}, &Row::v_WB_W_cmd);
  columns.add("cmd_altitude_m", &Row::altitude_cmd_m);
  columns.add("cmd_heading_rad", &Row::heading_cmd_rad);
}

}  // namespace

Table trajectory_columns(const Flight& flight) {
  using Row = TrajectoryRow;
  Columns<Row> columns(flight.trajectory);
  columns.add("t_s", &Row::t_s);
  columns.add({"north_m", "east_m", "down_m"}, &Row::p_WB_true);
  columns.add({"roll_rad", "pitch_rad", "yaw_rad"}, &Row::rpy_true);
  columns.add({"v_north_mps", "v_east_mps", "v_down_mps"}, &Row::v_WB_W_true);
  columns.add({"p_radps", "q_radps", "r_radps"}, &Row::w_WB_B_true);
  columns.add({"est_north_m", "est_east_m", "est_down_m"}, &Row::p_WB_est);
  columns.add({"est_roll_rad", "est_pitch_rad", "est_yaw_rad"}, &Row::rpy_est);
  columns.add({"est_v_north_mps", "est_v_east_mps", "est_v_down_mps"}, &Row::v_WB_W_est);
  add_command(columns);
  columns.add("clearance_m", &Row::obstacle_clearance_m);
  columns.add("ground_clearance_m", &Row::ground_clearance_m);
  for (size_t i = 0; i < flight.control_names.size(); ++i) {
    columns.add(flight.control_names[i], [i](const Row& row) { return row.controls[static_cast<Eigen::Index>(i)]; });
  }
  columns.add({"wind_north_mps", "wind_east_mps", "wind_down_mps"}, &Row::wind_W);
  columns.add("model_valid", [](const Row& row) { return row.model_valid ? 1.0 : 0.0; });
  columns.add("range_m", &Row::range_m);
  return columns.take();
}

Table decision_columns(const Flight& flight) {
  using Row = DecisionRow;
  Columns<Row> columns(flight.decisions);
  columns.add("t_s", &Row::t_s);
  columns.add_words("status", &Row::status);
  add_command(columns);
  for (size_t i = 0; i < flight.signals.size(); ++i) {
    columns.add(flight.signals[i].name, [i](const Row& row) { return i < row.signals.size() ? row.signals[i] : NAN; });
  }
  return columns.take();
}

}  // namespace hedgehop::sim
