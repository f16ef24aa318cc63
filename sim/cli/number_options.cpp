#include "sim/cli/campaign_options.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "sim/config/numbers.h"

namespace hedgehop::sim::cli {
namespace {

/// CLI11's own print the largest double in full.
template <class Holds>
CLI::Validator sign(const char* name, const char* must, Holds holds) {
  const auto check = [must, holds](std::string& text) -> std::string {
    const ParsedNumber parsed = parse_number(text, /*degrees=*/false);
    return parsed.kind == ParsedNumber::Kind::number && holds(parsed.member) ? ""
                                                                             : "must be " + (must + (", got " + text));
  };
  return CLI::Validator(check, name);
}

}  // namespace

CLI::Validator existing_folder() {
  const auto check = [](const std::string& path) -> std::string {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) return "";
    if (error && error != std::errc::no_such_file_or_directory) return path + ": " + error.message();
    return path + (std::filesystem::exists(path, error) ? ": is a file; valid: a folder" : ": there is no such folder");
  };
  return CLI::Validator(check, "DIR");
}

CLI::Validator whole_number() {
  const auto read = [](std::string& text) -> std::string {
    const std::optional<uint64_t> number = parse_unsigned(text);
    if (!number) return "'" + text + "' is no whole number from 0 to 18446744073709551615";
    text = std::to_string(*number);
    return "";
  };
  return CLI::Validator(read, "");
}

CLI::Validator number() {
  const auto read = [](std::string& text) -> std::string {
    const ParsedNumber parsed = parse_number(text, /*degrees=*/false);
    return parsed.kind == ParsedNumber::Kind::number ? "" : "'" + text + "' is no finite number";
  };
  return CLI::Validator(read, "");
}

CLI::Validator not_negative() {
  return sign("NONNEGATIVE", "0 or more", [](double value) { return value >= 0.0; });
}

CLI::Validator positive() {
  return sign("POSITIVE", "more than 0", [](double value) { return value > 0.0; });
}

}  // namespace hedgehop::sim::cli
