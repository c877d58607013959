#pragma once

#include <string>

#include "demo/corpus.h"

namespace signweave::demo {

/// A contact sheet (SVG) of one sentence, numbered from 0, with the given number of figures per second. `turn`: degrees
/// to the signer's left, see ContactSheetOptions.
std::string sentence_sheet(const SyntheticRecording& recording, std::size_t sentence, double turn = 0,
                           double figures_per_second = 10);

/// A contact sheet (SVG) of every handshape: the right hand seen from the palm and from the thumb's side.
std::string handshape_sheet();

}  // namespace signweave::demo
