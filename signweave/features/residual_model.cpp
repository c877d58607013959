#include "signweave/features/residual_model.h"

#include <cmath>

namespace signweave {

bool wins(const ResidualModel& model) noexcept {
  return model.folds > 0 && model.mean_ratio < 0.99f && model.median_ratio <= 1.0f;
}

bool nearly_same(const ResidualModel& a, const ResidualModel& b) noexcept {
  return a.movements == b.movements && a.recordings == b.recordings && a.folds == b.folds &&
         a.by_signer == b.by_signer && a.centres.size() == b.centres.size() &&
         std::abs(a.mean_ratio - b.mean_ratio) < 0.01f && std::abs(a.median_ratio - b.median_ratio) < 0.01f;
}

void encode(const ResidualModel& model, ByteWriter& out) {
  out.number(model.movements);
  out.number(model.recordings);
  out.number(model.folds);
  out.number(static_cast<std::uint8_t>(model.by_signer));
  out.number(model.mean_ratio);
  out.number(model.median_ratio);
  const auto all = [&](const auto& numbers) {
    for (const float number : numbers) out.number(number);
  };
  all(model.gate_mean);
  all(model.gate_scale);
  all(model.trait_scale);
  out.number(static_cast<std::uint32_t>(model.centres.size()));
  for (const ResidualModel::Centre& centre : model.centres) {
    all(centre.gates);
    all(centre.weights);
  }
}

ResidualModel decode_residual_model(ByteReader& in) {
  const auto finite = [&] {
    const auto number = in.number<float>();
    if (!std::isfinite(number)) in.fail("a value of the residual model is not finite");
    return number;
  };
  const auto all = [&](auto& numbers) {
    for (float& number : numbers) number = finite();
  };
  ResidualModel model;
  model.movements = in.number<std::uint64_t>();
  model.recordings = in.number<std::uint64_t>();
  model.folds = in.number<std::uint64_t>();
  const auto by_signer = in.number<std::uint8_t>();
  if (by_signer > 1) in.fail("the by-signer flag is neither 0 nor 1");
  model.by_signer = by_signer == 1;
  model.mean_ratio = finite();
  model.median_ratio = finite();
  all(model.gate_mean);
  all(model.gate_scale);
  all(model.trait_scale);
  const std::size_t count =
      in.count((ResidualModel::kGates + ResidualModel::kTraits * ResidualModel::kBends) * sizeof(float));
  if (count > 0) {
    for (const float scale : model.gate_scale) {
      if (!(scale > 0)) in.fail("a scale of the residual model is not positive");
    }
    for (const float scale : model.trait_scale) {
      if (!(scale > 0)) in.fail("a scale of the residual model is not positive");
    }
  }
  model.centres.resize(count);
  for (ResidualModel::Centre& centre : model.centres) {
    all(centre.gates);
    all(centre.weights);
  }
  return model;
}

}  // namespace signweave
