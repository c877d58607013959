#pragma once

#include "signweave/formats/eaf/parse.h"

namespace signweave::eaf {

/// Gives each slot its rank, each annotation its span, each annotation with slots its parent, and brings the
/// annotations of every tier into time order. `tier_order` lists the tiers, parents before children; the parents of
/// annotations without slots are known and exist.
///
/// Our reading of ELAN, after what it shows (and how its sources compute "virtual times"):
/// - Order of slots: as in TIME_ORDER, but a slot whose time is less than that of a slot before it moves to just before
///   the first slot that is later. Unaligned slots keep their place after the slot they were written after.
/// - An annotation with slots belongs to the parent that shares its begin slot, else its end slot, else whose slots lie
///   around its own in that order (and, where its own both have times, whose span contains it), else whose span
///   contains its own, else whose span shares most time with it.
/// - Unaligned slots are interpolated inside one parent: of the slots that the children of one parent use on one tier,
///   each run without times is spread evenly between its two neighbours, in whole milliseconds rounded down, so that
///   the last piece is the longest. Where a run begins or ends without a neighbour, the parent's own bound stands in.
///   Parents come first, so what they share with children is settled.
/// - Unaligned slots without any parent lie evenly between their neighbours in TIME_ORDER.
/// - Symbolic subdivision: the n children of a parent, in the order of their PREVIOUS_ANNOTATION chain, take the n-ths
///   of its span, bounds rounded down. Symbolic association: the parent's span.
/// An annotation that ends before it begins is unsound; one left out takes along what refers to it.
void settle_times(const Xml& xml, Unsound unsound, FileParts& parts, const std::vector<std::size_t>& tier_order);

}  // namespace signweave::eaf
