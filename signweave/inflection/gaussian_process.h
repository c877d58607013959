#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

/// Internal to this module.
namespace signweave {

/// What a value depends on.
struct ProcessInput {
  std::vector<Eigen::Vector3d> places;  ///< the same number for all inputs, at least one
  Eigen::VectorXd basis;                ///< values of the basis functions of the mean, about -1 to 1
};

/// Gaussian process regression of some outputs that are uncorrelated: a mean that is linear in the basis functions,
/// with a Gaussian prior on the coefficients (ridge), plus a process with a squared exponential kernel over the places,
/// plus noise (Rasmussen & Williams, Gaussian Processes for Machine Learning, 2006, 2.7). The kernel is a mixture of
/// the mean and the product of one kernel for each place. Its scale, size and mixture are common to all outputs and,
/// like the noise of each output, those of a small grid with the largest marginal likelihood.
class GaussianProcess {
 public:
  enum class Uses { mean_and_kernel, mean_alone };

  /// `values`: [input][output]. `arc`: the distance in places that one radian of arc is. Preconditions: at least two
  /// inputs; all values finite.
  GaussianProcess(std::vector<ProcessInput> inputs, const Eigen::MatrixXd& values, double arc, Uses uses);

  struct Value {
    Eigen::VectorXd mean;      ///< [output]
    Eigen::VectorXd variance;  ///< [output] of the mean
    Eigen::VectorXd noise;     ///< [output] variance of one observation
  };
  Value at(const ProcessInput& input) const;

  double log_likelihood() const noexcept { return log_likelihood_; }
  double scale_degrees() const noexcept { return shape_.scale_degrees; }

 private:
  struct Shape {
    double scale_degrees = 40;
    double size = 0;     ///< variance of the process over that of a coefficient
    double product = 0;  ///< share of the product kernel
  };
  struct Output {
    double scale = 1;  ///< variance of a coefficient
    double noise = 1;  ///< variance over `scale`
    Eigen::VectorXd weights;
    Eigen::MatrixXd inverse;
  };
  double covariance(const Shape& shape, const ProcessInput& a, const ProcessInput& b) const;
  double fit(const Eigen::MatrixXd& covariances, const Eigen::VectorXd& values, Output& best) const;

  std::vector<ProcessInput> inputs_;
  double arc_;
  Eigen::VectorXd middle_;  ///< [output]
  Shape shape_;
  std::vector<Output> outputs_;
  double log_likelihood_ = 0;
};

}  // namespace signweave
