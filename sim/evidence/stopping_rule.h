#pragma once

#include <variant>

#include "sim/evidence/pair_claim.h"
#include "sim/evidence/rate_claim.h"

namespace hedgehop::sim {

/// A claim that ends a batch once its flights show or refute it, and how surely.
struct StoppingRule {
  std::variant<RateClaim, PairClaim> claim;
  double confidence = 0.95;

  const std::string& text() const {
    return std::visit([](const auto& c) -> const std::string& { return c.text; }, claim);
  }
};

}  // namespace hedgehop::sim
