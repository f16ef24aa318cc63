#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace hedgehop::fuzz {

/// Changes texts like a fuzzer without coverage; equal seeds give equal changes.
class Mutation {
 public:
  explicit Mutation(uint64_t seed) : random_(seed) {}

  /// @param others  texts to take pieces from; not empty.
  std::string of(std::string text, const std::vector<std::string>& others) {
    for (uint64_t changes = 1 + below(4); changes > 0; --changes) change(text, others[below(others.size())]);
    return text;
  }

 private:
  static constexpr std::array<std::string_view, 28> kPieces = {"-1",
                                                               "0",
                                                               "1e308",
                                                               "-1e308",
                                                               "1e-320",
                                                               ".nan",
                                                               "nan",
                                                               ".inf",
                                                               "18446744073709551615",
                                                               "9223372036854775808",
                                                               "null",
                                                               "~",
                                                               "[]",
                                                               "{}",
                                                               "[[[[[[",
                                                               "{{{{",
                                                               "'",
                                                               "\"",
                                                               "\n",
                                                               "\r\n",
                                                               ":",
                                                               "- ",
                                                               "<<",
                                                               "*a",
                                                               "&a",
                                                               ",",
                                                               "#",
                                                               "%"};

  uint64_t below(uint64_t count) { return count == 0 ? 0 : random_() % count; }

  void change(std::string& text, const std::string& other) {
    const uint64_t at = below(text.size() + 1), length = below(std::min<uint64_t>(text.size() - at, 64) + 1);
    switch (below(7)) {
      case 0:
        if (!text.empty()) text[below(text.size())] = static_cast<char>(random_());
        return;
      case 1:
        text.erase(at, length);
        return;
      case 2:
        text.insert(at, kPieces[below(kPieces.size())]);
        return;
      case 3:
        text.replace(at, length, kPieces[below(kPieces.size())]);
        return;
      case 4:
        text.insert(at, text.substr(at, length));
        return;
      case 5:
        text.insert(at, other.substr(below(other.size() + 1), below(200)));
        return;
      default:
        text.resize(at);
    }
  }

  std::mt19937_64 random_;
};

}  // namespace hedgehop::fuzz
