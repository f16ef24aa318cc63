#include "sim/sweep/optimize.h"

#include <fmt/format.h>

#include <exception>
#include <nlopt.hpp>

namespace hedgehop::sim {
namespace {

constexpr double kFirstStep = 0.25;

nlopt::algorithm algorithm(OptimizeDesign::Method method) {
  switch (method) {
    case OptimizeDesign::Method::subplex:
      return nlopt::LN_SBPLX;
    case OptimizeDesign::Method::nelder_mead:
      return nlopt::LN_NELDERMEAD;
    case OptimizeDesign::Method::bobyqa:
      return nlopt::LN_BOBYQA;
    case OptimizeDesign::Method::direct:
      return nlopt::GN_DIRECT_L;
  }
  return nlopt::LN_SBPLX;
}

/// The cost function; stores its exception because NLopt passes on only its own exceptions.
struct Function {
  const std::function<double(const std::vector<double>&)>& cost;
  std::exception_ptr fault = {};

  static double call(const std::vector<double>& point, std::vector<double>&, void* data) {
    auto& function = *static_cast<Function*>(data);
    try {
      return function.cost(point);
    } catch (...) {
      function.fault = std::current_exception();
      throw nlopt::forced_stop();
    }
  }
};

}  // namespace

std::string minimize(const MinimizeOptions& options, const std::function<double(const std::vector<double>&)>& cost) {
  nlopt::opt optimizer(algorithm(options.method), static_cast<unsigned>(options.dimensions));
  optimizer.set_lower_bounds(0.0);
  optimizer.set_upper_bounds(1.0);
  optimizer.set_maxeval(options.max_points);
  optimizer.set_xtol_abs(options.tolerance);
  optimizer.set_initial_step(kFirstStep);
  Function function{.cost = cost};
  optimizer.set_min_objective(Function::call, &function);
  std::vector<double> x(options.dimensions, 0.5);
  double min_cost = 0.0;
  try {
    const nlopt::result end = optimizer.optimize(x, min_cost);
    if (end == nlopt::XTOL_REACHED) return fmt::format("converged to {:g} of each range", options.tolerance);
  } catch (const nlopt::roundoff_limited&) {
    return "converged to the limit of precision";
  } catch (const nlopt::forced_stop&) {
    try {
      std::rethrow_exception(function.fault);
    } catch (const StopMinimizing&) {
    }
  }
  return "";
}

}  // namespace hedgehop::sim
