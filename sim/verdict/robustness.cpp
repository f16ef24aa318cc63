#include "sim/verdict/robustness.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

double evaluate(const Expression& e, const SampledSignals& signals, size_t sample) {
  const auto part = [&](size_t i) { return evaluate(e.of[i], signals, sample); };
  switch (e.kind) {
    case Expression::Kind::number:
      return e.number;
    case Expression::Kind::signal:
      return signals.numbers.at(e.signal)[sample];
    case Expression::Kind::add:
      return part(0) + part(1);
    case Expression::Kind::subtract:
      return part(0) - part(1);
    case Expression::Kind::multiply:
      return part(0) * part(1);
    case Expression::Kind::divide:
      return part(0) / part(1);
    case Expression::Kind::negate:
      return -part(0);
    case Expression::Kind::abs:
      return std::abs(part(0));
    case Expression::Kind::min:
      return std::min(part(0), part(1));
    case Expression::Kind::max:
      return std::max(part(0), part(1));
  }
  return 0.0;
}

/// An interval in samples, both ends included; no last one where it lasts to the end.
struct Window {
  size_t first = 0;
  std::optional<size_t> last;
  bool empty() const { return last && *last < first; }
};

Window window(const TimeInterval& interval, double dt_s) {
  constexpr double kRoundOff = 1e-9;
  Window window{.first = static_cast<size_t>(std::ceil(interval.from_s / dt_s - kRoundOff)), .last = {}};
  if (interval.to_s) window.last = static_cast<size_t>(std::floor(*interval.to_s / dt_s + kRoundOff));
  return window;
}

/// Works bottom up, all samples of a part at once.
class Evaluator {
 public:
  explicit Evaluator(const SampledSignals& signals) : signals_(signals) {}
  size_t comparisons() const { return comparisons_; }

  Robustness of(const Formula& formula) {
    switch (formula.kind) {
      case Formula::Kind::at_least_zero:
      case Formula::Kind::has_status:
        return of_samples(formula);
      case Formula::Kind::negation:
        return negated(of(formula.of[0]));
      case Formula::Kind::conjunction:
        return lesser(of(formula.of[0]), of(formula.of[1]));
      case Formula::Kind::disjunction:
        return greater(of(formula.of[0]), of(formula.of[1]));
      case Formula::Kind::implication:
        return greater(negated(of(formula.of[0])), of(formula.of[1]));
      case Formula::Kind::always:
        return least(of(formula.of[0]), window(formula.interval, signals_.dt_s));
      case Formula::Kind::eventually:
        return most(of(formula.of[0]), window(formula.interval, signals_.dt_s));
      case Formula::Kind::until:
        return until(of(formula.of[0]), of(formula.of[1]), window(formula.interval, signals_.dt_s));
    }
    return {};
  }

 private:
  Robustness filled(double value) const {
    return {std::vector<double>(signals_.samples, value), std::vector<size_t>(signals_.samples, 0), 0};
  }

  Robustness of_samples(const Formula& formula) const {
    Robustness r = filled(0.0);
    for (size_t i = 0; i < signals_.samples; ++i) {
      if (formula.kind == Formula::Kind::has_status) {
        r.value[i] = signals_.status.at(i) == formula.status ? kInfinity : -kInfinity;
      } else {
        const double margin = evaluate(formula.margin, signals_, i);
        r.value[i] = std::isnan(margin) ? -kInfinity : margin;
      }
      r.decisive[i] = i;
    }
    return r;
  }

  static Robustness negated(Robustness r) {
    for (double& value : r.value) value = -value;
    return r;
  }

  /// Of equals the one that is decided first in time.
  bool is_less(double a, size_t a_at, double b, size_t b_at) {
    ++comparisons_;
    return a < b || (a == b && a_at < b_at);
  }

  Robustness lesser(Robustness a, const Robustness& b) {
    for (size_t i = 0; i < a.value.size(); ++i) {
      if (is_less(a.value[i], a.decisive[i], b.value[i], b.decisive[i])) continue;
      a.value[i] = b.value[i];
      a.decisive[i] = b.decisive[i];
    }
    return a;
  }
  Robustness greater(Robustness a, Robustness b) {
    return negated(lesser(negated(std::move(a)), negated(std::move(b))));
  }

  /// The least of each sample's window. The queue holds, from the front, the window's samples that are less than all
  /// before them: the first is the newest, since time runs backwards, and the last is the least.
  Robustness least(const Robustness& r, Window window) {
    Robustness result = filled(kInfinity);
    const size_t samples = r.value.size();
    if (window.empty()) return result;
    std::deque<size_t> queue;
    for (size_t i = samples; i-- > 0;) {
      result.decisive[i] = samples - 1;
      if (window.first >= samples - i) continue;
      const size_t entering = i + window.first;
      while (!queue.empty() &&
             is_less(r.value[entering], r.decisive[entering], r.value[queue.front()], r.decisive[queue.front()])) {
        queue.pop_front();
      }
      queue.push_front(entering);
      while (window.last && queue.back() - i > *window.last) queue.pop_back();
      result.value[i] = r.value[queue.back()];
      result.decisive[i] = r.decisive[queue.back()];
    }
    return result;
  }
  Robustness most(Robustness r, Window window) { return negated(least(negated(std::move(r)), window)); }

  /// f until[a,b] g = eventually[a,b] g, and always[0,a) f, and f until g a samples later.
  Robustness until(const Robustness& f, const Robustness& g, Window window) {
    const size_t samples = g.value.size();
    Robustness unbounded = g;  // max(g_i, min(f_i, of the next)), from the end
    for (size_t i = samples; i-- > 1;) {
      const size_t now = i - 1;
      const bool f_less = is_less(f.value[now], f.decisive[now], unbounded.value[i], unbounded.decisive[i]);
      const double value = f_less ? f.value[now] : unbounded.value[i];
      if (is_less(value, 0, g.value[now], 0) || value == g.value[now]) continue;
      unbounded.value[now] = value;
      unbounded.decisive[now] = f_less ? f.decisive[now] : unbounded.decisive[i];
    }
    Robustness later = filled(-kInfinity);
    for (size_t i = 0; i < samples && window.first < samples - i; ++i) {
      later.value[i] = unbounded.value[i + window.first];
      later.decisive[i] = unbounded.decisive[i + window.first];
    }
    Robustness result = lesser(most(g, window), later);
    if (window.first > 0) result = lesser(std::move(result), least(f, {.first = 0, .last = window.first - 1}));
    return result;
  }

  const SampledSignals& signals_;
  size_t comparisons_ = 0;
};

}  // namespace

Robustness robustness(const Formula& formula, const SampledSignals& signals) {
  Evaluator evaluator(signals);
  Robustness result = evaluator.of(formula);
  result.comparisons = evaluator.comparisons();
  return result;
}

}  // namespace hedgehop::sim
