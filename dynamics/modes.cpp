#include "dynamics/modes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <tuple>
#include <utility>

namespace hedgehop::dynamics {
namespace {

/// Parts of the states in one mode; their sum is 1. Each is the product of the state's components in the right and left
/// eigenvectors, so the units of the states have no effect.
class Participation {
 public:
  Participation(const std::vector<std::string>& states, const Eigen::VectorXd& parts)
      : states_(states), parts_(parts) {}

  /// Returns the sum of the parts of these states.
  double of(std::initializer_list<std::string_view> names) const {
    double sum = 0.0;
    for (size_t i = 0; i < states_.size(); ++i) {
      if (std::find(names.begin(), names.end(), states_[i]) != names.end()) sum += parts_[static_cast<Eigen::Index>(i)];
    }
    return sum;
  }

 private:
  const std::vector<std::string>& states_;
  Eigen::VectorXd parts_;
};

constexpr double kMost = 0.5, kMuch = 0.25, kSome = 0.2;  // chosen: parts of states in a mode

std::string motors_name(const Participation& p) {
  constexpr std::pair<const char*, const char*> kMotors[] = {
      {"T", "motors, thrust"}, {"L", "motors, roll"}, {"M", "motors, pitch"}, {"N", "motors, yaw"}};
  for (const auto& [state, name] : kMotors) {
    if (p.of({state}) > kMuch) return name;
  }
  return "motors";
}

std::string rotor_name(const Participation& p) {
  const double roll = p.of({"p"}), pitch = p.of({"q"});
  if (std::max(roll, pitch) > kSome) return roll > pitch ? "roll and flapping" : "pitch and flapping";
  return p.of({"c", "d"}) > kSome ? "flapping and stabilizer bar" : "flapping";
}

std::string oscillation_name(const Participation& p, bool hovers) {
  const double pitch = p.of({"u", "q", "theta"}), roll = p.of({"v", "p", "phi"});
  if (p.of({"r"}) > kMuch) return "Dutch roll";
  if (p.of({"w"}) > kSome && p.of({"w", "q"}) > kMost) return "short period";
  if (std::abs(pitch - roll) < kSome) return "hover cubics, pitch and roll coupled";
  if (pitch > roll) return hovers || p.of({"q"}) > kSome ? "hover cubic, longitudinal oscillation" : "phugoid";
  return "hover cubic, lateral oscillation";
}

std::string real_name(const Participation& p, double eigenvalue) {
  const std::string way = eigenvalue > 0.0 ? " divergence" : " subsidence";
  if (p.of({"w"}) > kMost) return "heave" + way;
  if (p.of({"r"}) > kMost) return "yaw" + way;
  if (p.of({"phi"}) > kMost) return "spiral";
  return p.of({"v", "p", "phi"}) > p.of({"u", "q", "theta"}) ? "roll" + way : "pitch" + way;
}

std::string name_of(const Participation& p, std::complex<double> eigenvalue, bool hovers) {
  if (p.of({"psi"}) > kMost) return "heading";
  if (p.of({"T", "L", "M", "N"}) > kMost) return motors_name(p);
  if (p.of({"a", "b", "c", "d"}) > kMuch) return rotor_name(p);
  if (eigenvalue == 0.0 && p.of({"w"}) > kMost) return "heave, neutral";
  if (eigenvalue == 0.0 && p.of({"psi", "w"}) > kMost) return "heading and heave, neutral";
  return eigenvalue.imag() > 0.0 ? oscillation_name(p, hovers) : real_name(p, eigenvalue.real());
}

}  // namespace

std::vector<Mode> modes(const NamedLinearSystem& linear, double airspeed_mps) {
  constexpr double kHoverMps = 1.0, kNeutralRadps = 1e-9;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(Eigen::MatrixXd(linear.system.A));
  const Eigen::VectorXcd values = solver.eigenvalues();
  const Eigen::MatrixXcd right = solver.eigenvectors();
  const Eigen::FullPivLU<Eigen::MatrixXcd> lu(right);
  const bool defective = !lu.isInvertible();
  const Eigen::MatrixXcd left = defective ? Eigen::MatrixXcd(right.adjoint()) : Eigen::MatrixXcd(lu.inverse());
  std::vector<Mode> out;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values[i].imag() < 0.0) continue;
    const Eigen::VectorXd parts = right.col(i).cwiseProduct(left.row(i).transpose()).cwiseAbs();
    Eigen::Index largest = 0;
    parts.maxCoeff(&largest);
    // Two eigenvalues of 0 can be computed as a complex pair.
    const std::complex<double> value = std::abs(values[i]) < kNeutralRadps ? 0.0 : values[i];
    const double magnitude = std::abs(value);
    const Participation participation(linear.states, parts / parts.sum());
    out.push_back({value, magnitude, magnitude > 0.0 ? -value.real() / magnitude : 0.0,
                   name_of(participation, value, std::abs(airspeed_mps) < kHoverMps),
                   right.col(i) / right(largest, i)});
  }
  std::sort(out.begin(), out.end(), [](const Mode& a, const Mode& b) {
    return std::tuple(a.frequency_radps, a.eigenvalue.real()) < std::tuple(b.frequency_radps, b.eigenvalue.real());
  });
  return out;
}

}  // namespace hedgehop::dynamics
