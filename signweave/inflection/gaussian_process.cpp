#include "signweave/inflection/gaussian_process.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace signweave {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The grid. (ours)
constexpr std::array kScales = {40.0, 28.0, 20.0, 57.0, 80.0};  // degrees
constexpr std::array kSizes = {0.03, 0.1, 0.3, 1.0};
constexpr std::array kProducts = {0.0, 0.3, 1.0};
constexpr std::array kNoises = {3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0};
/// A variance is at least this, so that constant outputs have a likelihood.
constexpr double kLeastVariance = 1e-12;

}  // namespace

double GaussianProcess::covariance(const Shape& shape, const ProcessInput& a, const ProcessInput& b) const {
  const double mean = a.basis.dot(b.basis);
  if (shape.size == 0) return mean;
  const double scale = arc_ * shape.scale_degrees * std::numbers::pi / 180;
  double sum = 0;
  double product = 1;
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    const double near = std::exp(-0.5 * (a.places[i] - b.places[i]).squaredNorm() / (scale * scale));
    sum += near / static_cast<double>(a.places.size());
    product *= near;
  }
  return mean + shape.size * ((1 - shape.product) * sum + shape.product * product);
}

/// Fits one output for given covariances, without noise. Returns its log likelihood.
double GaussianProcess::fit(const MatrixXd& covariances, const VectorXd& values, Output& best) const {
  const auto count = static_cast<double>(values.size());
  double most = -std::numeric_limits<double>::infinity();
  for (const double noise : kNoises) {
    MatrixXd all = covariances;
    all.diagonal().array() += noise;
    const Eigen::LLT<MatrixXd> solver(all);
    if (solver.info() != Eigen::Success) continue;
    const VectorXd weights = solver.solve(values);
    const double scale = std::max(values.dot(weights) / count, kLeastVariance);
    const double determinant = 2 * solver.matrixLLT().diagonal().array().log().sum();
    const double likelihood = -0.5 * (count * std::log(2 * std::numbers::pi * scale) + determinant + count);
    if (!(likelihood > most)) continue;
    most = likelihood;
    best = {.scale = scale, .noise = noise, .weights = weights, .inverse = {}};
  }
  return most;
}

GaussianProcess::GaussianProcess(std::vector<ProcessInput> inputs, const MatrixXd& values, double arc, Uses uses)
    : inputs_(std::move(inputs)), arc_(arc), middle_(values.colwise().mean()) {
  const auto count = static_cast<Eigen::Index>(inputs_.size());
  const MatrixXd centred = values.rowwise() - middle_.transpose();
  const auto covariances_of = [&](const Shape& shape) {
    MatrixXd all(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) {
        all(i, j) = all(j, i) =
            covariance(shape, inputs_[static_cast<std::size_t>(i)], inputs_[static_cast<std::size_t>(j)]);
      }
    }
    return all;
  };
  log_likelihood_ = -std::numeric_limits<double>::infinity();
  const auto take = [&](const Shape& shape) {
    const MatrixXd covariances = covariances_of(shape);
    std::vector<Output> outputs(static_cast<std::size_t>(values.cols()));
    double likelihood = 0;
    for (Eigen::Index k = 0; k < values.cols(); ++k) {
      likelihood += fit(covariances, centred.col(k), outputs[static_cast<std::size_t>(k)]);
    }
    if (!(likelihood > log_likelihood_) && !outputs_.empty()) return;
    log_likelihood_ = likelihood;
    shape_ = shape;
    outputs_ = std::move(outputs);
  };
  if (uses == Uses::mean_alone) {
    take({});
  } else {
    const bool one_place = inputs_.front().places.size() < 2;
    for (const double scale : kScales) {
      for (const double size : kSizes) {
        for (const double product : kProducts) {
          if (one_place && product > 0) continue;
          take({.scale_degrees = scale, .size = size, .product = product});
        }
      }
    }
  }
  const MatrixXd covariances = covariances_of(shape_);
  for (Output& output : outputs_) {
    MatrixXd all = covariances;
    all.diagonal().array() += output.noise;
    output.inverse = all.llt().solve(MatrixXd::Identity(count, count));
  }
}

GaussianProcess::Value GaussianProcess::at(const ProcessInput& input) const {
  VectorXd near(static_cast<Eigen::Index>(inputs_.size()));
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    near[static_cast<Eigen::Index>(i)] = covariance(shape_, input, inputs_[i]);
  }
  const double own = covariance(shape_, input, input);
  const auto count = static_cast<Eigen::Index>(outputs_.size());
  Value value{.mean = middle_, .variance = VectorXd(count), .noise = VectorXd(count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const Output& output = outputs_[static_cast<std::size_t>(k)];
    value.mean[k] += near.dot(output.weights);
    value.variance[k] = output.scale * std::max(0.0, own - near.dot(output.inverse * near));
    value.noise[k] = output.scale * output.noise;
  }
  return value;
}

}  // namespace signweave
