#include "dynamics/control/lqr.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>
#include <stdexcept>

namespace hedgehop::dynamics::control {
namespace {

DesignMatrix scalar(double x) { return DesignMatrix::Constant(1, 1, x); }

TEST(Sampled, DoubleIntegratorAndOscillatorAreExact) {
  LinearSystem s{DesignMatrix::Zero(2, 2), DesignMatrix::Zero(2, 1)};
  s.A(0, 1) = 1.0;
  s.B(1, 0) = 1.0;
  const LinearSystem d = sampled(s, 0.3);
  EXPECT_NEAR(d.A(0, 1), 0.3, 1e-15);
  EXPECT_NEAR(d.B(0, 0), 0.045, 1e-15);
  EXPECT_NEAR(d.B(1, 0), 0.3, 1e-15);

  s.A(1, 0) = -400.0;  // 20 rad/s
  const LinearSystem o = sampled(s, 0.3);
  EXPECT_NEAR(o.A(0, 0), std::cos(6.0), 1e-12);
  EXPECT_NEAR(o.A(0, 1), std::sin(6.0) / 20.0, 1e-13);
  EXPECT_NEAR(o.B(0, 0), (1.0 - std::cos(6.0)) / 400.0, 1e-14);
}

TEST(Lqr, ScalarGainIsTheClosedForm) {
  for (const double a : {0.5, 1.0, 1.7}) {
    // p = q + a^2 p r / (r + p), a quadratic in p.
    const double q = 2.0, r = 3.0, half = 0.5 * (q - r + a * a * r);
    const double p = half + std::sqrt(half * half + q * r);
    EXPECT_NEAR(lqr_gain({scalar(a), scalar(1.0)}, scalar(q), scalar(r))(0, 0), a * p / (r + p), 1e-12);
  }
}

TEST(Lqr, NoOtherGainCostsLess) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const auto draw = [&](Eigen::Index rows, Eigen::Index cols) {
    DesignMatrix m(rows, cols);
    for (Eigen::Index j = 0; j < cols; ++j) {
      for (Eigen::Index i = 0; i < rows; ++i) m(i, j) = normal(random);
    }
    return m;
  };
  const auto cost = [](const LinearSystem& s, const DesignMatrix& K, const DesignVector& x0) {
    DesignVector x = x0;
    double sum = 0.0;
    for (int i = 0; i < 3000; ++i) {
      const DesignVector u = -K * x;
      sum += x.squaredNorm() + u.squaredNorm();
      x = DesignVector(s.A * x + s.B * u);
    }
    return sum;
  };
  for (int trial = 0; trial < 20; ++trial) {
    const LinearSystem s{draw(6, 6) * 0.5, draw(6, 2)};
    const DesignMatrix K = lqr_gain(s, DesignMatrix::Identity(6, 6), DesignMatrix::Identity(2, 2));
    const Eigen::MatrixXd closed = s.A - s.B * K;
    ASSERT_LT(closed.eigenvalues().cwiseAbs().maxCoeff(), 1.0);
    const DesignVector x0 = draw(6, 1);
    const double best = cost(s, K, x0);
    for (int i = 0; i < 5; ++i) EXPECT_GT(cost(s, K + 0.01 * draw(2, 6), x0), best);
  }
}

TEST(Lqr, RefusesAnUncontrollableUnstableSystem) {
  EXPECT_THROW(lqr_gain({scalar(1.1), scalar(0.0)}, scalar(1.0), scalar(1.0)), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::dynamics::control
