#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hedgehop::scenes::mesh {

/// Returns a URI with its percent signs decoded: "a%20b" is "a b".
std::string percent_decoded(std::string_view uri);

/// Returns the bytes of a text in base 64. Other characters are skipped.
std::vector<uint8_t> base64_decoded(std::string_view text);

}  // namespace hedgehop::scenes::mesh
