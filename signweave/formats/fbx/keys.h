#pragma once

#include <unordered_map>
#include <vector>

#include "signweave/formats/fbx/array.h"
#include "signweave/formats/fbx/curve.h"
#include "signweave/formats/fbx/tree.h"

/// The keys of curves, and the interpolation between them.
namespace signweave::fbx {

/// Curves by their record.
using Curves = std::unordered_map<const Record*, Curve>;

/// Reads the curves of these records (each an AnimationCurve); one that is listed twice is read once. Throws as
/// Source::fail does if one is damaged, or if together they hold more than Arrays allows for a file of its size.
Curves read_curves(const Source& source, const std::vector<const Record*>& records);

}  // namespace signweave::fbx
