#include "sim/cli/number_options.h"

#include <cstdint>
#include <optional>
#include <string>

#include "sim/scenario/numbers.h"

namespace hedgehop::sim::cli {

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

}  // namespace hedgehop::sim::cli
