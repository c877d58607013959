#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "signweave/formats/fbx_array.h"
#include "signweave/formats/fbx_curve.h"
#include "signweave/formats/fbx_tree.h"

/// The keys of curves, which Assimp reads.
///
/// Assimp 5.2.5 is not given the file: nodes in a circle or records nested deep end the program, and of whole files it
/// gets much wrong (post-rotation turned the wrong way, parts without a curve at 0 where there are pivots, keys outside
/// of the take's range dropped, nodes of one name mixed, short pivots left out, tangents ignored). It is given a small
/// document with nothing but curves, each alone on a node of its own that has no transform, written from arrays that
/// were checked: there it reads each key as it stands, and must. What lies between keys, and what they turn, is ours.
namespace signweave::fbx {

/// Curves by their record.
using Curves = std::unordered_map<const Record*, Curve>;

/// Reads the curves of these records (each an AnimationCurve). Throws as Source::fail does where one is damaged.
Curves read_curves(const Source& source, const std::vector<const Record*>& records);

/// A document of version 7.4, binary, in which each curve moves the node "c" + its number along x; before them stands
/// one with a key at 0, for Assimp counts time from the first key of all.
std::string document_of_curves(const std::vector<Curve>& curves);

/// The curves of such a document, as Assimp reads them, without what lies between keys. Throws Error{bad_input} where
/// it does not give `count`.
std::vector<Curve> read_by_assimp(const std::string& document, std::size_t count);

}  // namespace signweave::fbx
