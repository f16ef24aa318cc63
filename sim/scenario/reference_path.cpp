#include "sim/scenario/reference_path.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "sim/config/numbers.h"
#include "sim/config/whole_file.h"

namespace hedgehop::sim {
namespace {

constexpr std::string_view kHeader = "t_s,north_m,east_m,altitude_m";

[[noreturn]] void refuse(const std::filesystem::path& file, int line, std::string_view why) {
  throw std::invalid_argument(fmt::format("{}:{}: {}", file.string(), line, why));
}

/// Returns the text after "# key: ", if any.
std::string_view after_key(std::string_view line, std::string_view key) {
  const std::string begin = fmt::format("# {}: ", key);
  return line.starts_with(begin) ? line.substr(begin.size()) : std::string_view();
}

double number(std::string_view text, const std::filesystem::path& file, int line) {
  const ParsedNumber parsed = parse_number(text, false);
  if (parsed.kind != ParsedNumber::Kind::number) refuse(file, line, fmt::format("'{}' is no finite number", text));
  return parsed.member;
}

TimedPoint point(std::string_view line, const std::filesystem::path& file, int number_of_line) {
  std::array<double, 4> fields{};
  for (size_t i = 0; i < fields.size(); ++i) {
    const size_t comma = line.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == fields.size()))
      refuse(file, number_of_line, "expected 4 fields");
    fields[i] = number(line.substr(0, comma), file, number_of_line);
    line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
  }
  return {fields[0], {fields[1], fields[2], -fields[3]}};
}

}  // namespace

std::vector<TimedPoint> thinned(const std::vector<TimedPoint>& points, double step_s) {
  constexpr double kRoundOffS = 1e-9;
  std::vector<TimedPoint> kept;
  for (size_t i = 0; i < points.size(); ++i) {
    const bool due = kept.empty() || points[i].t_s - kept.back().t_s >= step_s - kRoundOffS;
    if (due || i + 1 == points.size()) kept.push_back(points[i]);
  }
  return kept;
}

std::string reference_text(const ReferencePath& reference) {
  std::string text = fmt::format("# reason: {}\n# version: {}\n# seed: {}\n# step_s: {}\n{}\n", reference.reason,
                                 reference.version, reference.seed, reference.step_s, kHeader);
  const auto time_text = [](const TimedPoint& p) { return fmt::format("{:.3f}", p.t_s); };
  for (size_t i = 0; i < reference.points.size(); ++i) {
    const TimedPoint& p = reference.points[i];
    if (i + 1 < reference.points.size() && time_text(p) == time_text(reference.points[i + 1])) continue;
    text += fmt::format("{},{:.3f},{:.3f},{:.3f}\n", time_text(p), p.p_WB.x(), p.p_WB.y(), -p.p_WB.z());
  }
  return text;
}

namespace {

std::string reference_bytes(const std::filesystem::path& file) {
  try {
    return read_input_file(file);
  } catch (const std::invalid_argument& why) {
    throw std::invalid_argument(fmt::format("{}: {}; `hedgehop bless` writes it", file.string(), why.what()));
  }
}

}  // namespace

ReferencePath read_reference_path(const std::filesystem::path& file) {
  std::istringstream stream(reference_bytes(file));
  ReferencePath reference;
  bool header = false;
  std::string line;
  for (int number_of_line = 1; std::getline(stream, line); ++number_of_line) {
    if (const auto reason = after_key(line, "reason"); !reason.empty()) reference.reason = reason;
    if (const auto version = after_key(line, "version"); !version.empty()) reference.version = version;
    if (const auto seed = after_key(line, "seed"); !seed.empty()) reference.seed = parse_unsigned(seed).value_or(0);
    if (const auto step = after_key(line, "step_s"); !step.empty()) {
      reference.step_s = number(step, file, number_of_line);
      if (!(reference.step_s > 0.0)) refuse(file, number_of_line, "step_s must be > 0");
    }
    if (line.starts_with('#') || line.empty()) continue;
    if (!header) {
      if (line != kHeader) refuse(file, number_of_line, fmt::format("expected the columns {}", kHeader));
      header = true;
      continue;
    }
    const TimedPoint next = point(line, file, number_of_line);
    if (!reference.points.empty() && !(next.t_s > reference.points.back().t_s)) {
      refuse(file, number_of_line, "times must rise");
    }
    reference.points.push_back(next);
  }
  if (reference.points.empty()) throw std::invalid_argument(fmt::format("{}: no points", file.string()));
  return reference;
}

}  // namespace hedgehop::sim
