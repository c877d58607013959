#pragma once

#include <span>
#include <string>
#include <vector>

#include "signweave/drawing/locus_marks.h"
#include "signweave/rig/signer_space.h"

namespace signweave::calls {

/// The help of the parameter `signing_space`.
inline constexpr const char* kSigningSpaceHelp = "in .svg: the signer's heights and zones behind each figure";

inline constexpr const char* kLocusHelp =
    "in .svg: mark a locus in front of each figure: left, 30/10, or a=30/10 under a name of its own; may be given "
    "several times";
inline constexpr const char* kFromAboveHelp = "in .svg: show the figures from above";

/// Throws Error{bad_input} if a signing space is to be drawn and none of the files is a contact sheet. `parameter` is
/// what asks for it.
void check_signing_space(bool wanted, const std::vector<std::string>& paths,
                         std::string_view parameter = "signing_space");

/// Loci as parameters give them: NAME, NUMBERS or NAME=LOCUS, whose locus may be a name that was given before. Throws
/// Error{bad_input}, and Error{not_found} for an unknown name, with near matches.
std::vector<MarkedLocus> marked_loci(std::span<const std::string> texts, const SignerBody& body);
/// Empty, or why a text is no such locus by itself.
std::string check_marked_locus(const std::string& text);

}  // namespace signweave::calls
