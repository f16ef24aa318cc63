#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "dynamics/vehicle.h"
#include "sim/cli/commands.h"
#include "sim/cli/vehicle_commands.h"
#include "sim/config/input_error.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim::cli {
namespace {

/// Returns the first sentence of the comment at the head of a file.
std::string first_sentence(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string text, line;
  while (std::getline(in, line) && line.starts_with("#")) text += line.substr(1);
  for (size_t at = text.find(". "); at != std::string::npos; at = text.find(". ", at + 1)) {
    if (at + 2 < text.size() && std::isupper(static_cast<unsigned char>(text[at + 2]))) {
      text.resize(at + 1);
      break;
    }
  }
  return text.starts_with(" ") ? text.substr(1) : text;
}

}  // namespace

std::string vehicle_files_text() {
  std::string text = "\nvehicle files, for `vehicle: {use: ...}`:\n";
  for (const std::filesystem::path& file : shipped_files("vehicles")) {
    const dynamics::VehicleConfig vehicle = load_vehicle(file);
    const double mass_kg = std::visit([](const auto& config) { return config.mass.mass_kg; }, vehicle);
    const std::string_view kind = std::visit([](const auto& config) { return config.kName; }, vehicle);
    text += fmt::format("{}: {}, {:.3g} kg, {:.2f} m across\n    {}\n", file.string(), kind, mass_kg,
                        2.0 * dynamics::radius_m(dynamics::hull(vehicle)), first_sentence(file));
  }
  return text;
}

std::vector<double> speed_range(const std::string& text) {
  std::vector<double> numbers;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(':', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    size_t used = 0;
    try {
      numbers.push_back(std::stod(part, &used));
    } catch (const std::exception&) {
      used = 0;
    }
    if (used == 0 || used != part.size() || !std::isfinite(numbers.back())) {
      throw InputError(fmt::format("--speed {}: expected a speed in m/s or FROM:TO:STEP, such as -4:20:2", text));
    }
    begin = end + 1;
  }
  if (numbers.size() == 1) return numbers;
  if (numbers.size() != 3 || numbers[2] <= 0.0 || numbers[1] < numbers[0]) {
    throw InputError(fmt::format("--speed {}: expected FROM:TO:STEP with TO above FROM and STEP above 0", text));
  }
  constexpr double kMaxSteps = 10000, kRounding = 1e-9;
  const double steps = std::floor((numbers[1] - numbers[0]) / numbers[2] + kRounding);
  if (steps > kMaxSteps) {
    throw InputError(fmt::format("--speed {}: {:.10g} speeds; valid: at most {}; use a larger STEP", text, steps + 1.0,
                                 kMaxSteps + 1.0));
  }
  std::vector<double> speeds;
  for (int i = 0; i <= static_cast<int>(steps); ++i) speeds.push_back(numbers[0] + i * numbers[2]);
  return speeds;
}

}  // namespace hedgehop::sim::cli
