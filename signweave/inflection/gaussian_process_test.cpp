#include "signweave/inflection/gaussian_process.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace signweave {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

ProcessInput at_angle(double radians) {
  ProcessInput input{.places = {Vector3d(std::sin(radians), 0, std::cos(radians))}, .basis = VectorXd(2)};
  input.basis << 1, radians;
  return input;
}

GaussianProcess fitted(double noise, GaussianProcess::Uses uses) {
  std::mt19937 random(5);
  std::normal_distribution<double> drawn(0, noise);
  std::vector<ProcessInput> inputs;
  MatrixXd values(60, 1);
  for (int i = 0; i < 60; ++i) {
    const double angle = -1.5 + 0.05 * i;
    inputs.push_back(at_angle(angle));
    values(i, 0) = 3 + angle + std::sin(3 * angle) + drawn(random);
  }
  return {std::move(inputs), values, 1, uses};
}

TEST(GaussianProcess, FindsACurveThatItsMeanCannotFollow) {
  const GaussianProcess process = fitted(0.05, GaussianProcess::Uses::mean_and_kernel);
  const GaussianProcess line = fitted(0.05, GaussianProcess::Uses::mean_alone);
  double worst = 0;
  double worst_of_line = 0;
  for (const double angle : {-1.2, -0.53, 0.02, 0.61, 1.1}) {
    const double truth = 3 + angle + std::sin(3 * angle);
    worst = std::max(worst, std::abs(process.at(at_angle(angle)).mean[0] - truth));
    worst_of_line = std::max(worst_of_line, std::abs(line.at(at_angle(angle)).mean[0] - truth));
  }
  EXPECT_LT(worst, 0.05);
  EXPECT_GT(worst_of_line, 0.3);
  EXPECT_GT(process.log_likelihood(), line.log_likelihood());
}

TEST(GaussianProcess, ItsNoiseIsThatOfTheValuesAndItsOwnErrorGrowsAwayFromThem) {
  const GaussianProcess process = fitted(0.1, GaussianProcess::Uses::mean_and_kernel);
  const GaussianProcess::Value inside = process.at(at_angle(0));
  EXPECT_NEAR(std::sqrt(inside.noise[0]), 0.1, 0.05);
  EXPECT_LT(std::sqrt(inside.variance[0]), 0.08);
  EXPECT_GT(std::sqrt(process.at(at_angle(2.6)).variance[0]), 0.3);
}

TEST(GaussianProcess, ConstantValuesStayConstant) {
  const GaussianProcess process({at_angle(0), at_angle(1), at_angle(2)}, MatrixXd::Constant(3, 2, 4.5), 1,
                                GaussianProcess::Uses::mean_and_kernel);
  EXPECT_NEAR(process.at(at_angle(0.7)).mean[1], 4.5, 1e-9);
}

}  // namespace
}  // namespace signweave
