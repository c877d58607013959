#pragma once

#include "signweave/formats/eaf/parse.h"

namespace signweave::eaf {

/// Sets the rank of each slot, the span of each annotation and the parent of each annotation with slots, and sorts the
/// annotations of every tier by time. `tier_order` lists the tiers, parents before children; the parents of annotations
/// without slots are known and exist.
///
/// Our reading of ELAN, from what it shows (and how its sources compute "virtual times"):
/// - Order of slots: as in TIME_ORDER, but a slot whose time is less than that of a preceding slot moves to just before
///   the first slot that is later. Unaligned slots stay after the slot they were written after.
/// - The parent of an annotation with slots is the one that shares its begin slot, else its end slot, else the one
///   whose slots enclose its own in that order (and, if its own both have times, whose span contains it), else the one
///   whose span contains its own, else the one whose span shares the most time with it.
/// - Unaligned slots are interpolated inside one parent: of the slots that the children of one parent use on one tier,
///   each run without times is spread evenly between its two neighbours, in whole milliseconds rounded down, so that
///   the last part is the longest. If a run begins or ends without a neighbour, the parent's own bound is used. Parents
///   are processed first, so what they share with children is known.
/// - Unaligned slots without any parent are spread evenly between their neighbours in TIME_ORDER.
/// - Symbolic subdivision: the n children of a parent, in the order of their PREVIOUS_ANNOTATION chain, take equal
///   n-ths of its span, bounds rounded down. Symbolic association: the parent's span.
/// An annotation that ends before it begins is unsound; when one is left out, so is everything that refers to it.
void settle_times(const Xml& xml, Unsound unsound, FileParts& parts, const std::vector<std::size_t>& tier_order);

}  // namespace signweave::eaf
