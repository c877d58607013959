#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "signweave/space/locus.h"

namespace signweave {

/// How the movement of a sign relates to the loci that it is aimed at.
enum class SpaceRole : std::uint8_t {
  none,      ///< it is not aimed
  forward,   ///< a verb that goes from its subject to its object, such as DONNER
  backward,  ///< a verb that goes from its object to its subject, such as INVITER and PRENDRE
  aim,       ///< it is aimed at a locus, and does not go from one to another
  both,      ///< each hand comes from the locus on its side, as in RENCONTRER
};
/// "none", "forward", …
std::string_view name_of(SpaceRole role) noexcept;

/// The roles of glosses, by their match form.
using SpaceRoles = std::map<std::string, SpaceRole, std::less<>>;
/// None for a gloss that is not in the table.
std::optional<SpaceRole> role_of(const SpaceRoles& roles, std::string_view gloss);

/// Reads a table of roles: UTF-8 lines GLOSS,ROLE with an optional header, a gloss with commas in double quotes. Empty
/// lines and those that begin with "#" are skipped. Throws Error{bad_input, "FILE:LINE: …"} for a line that is
/// something else, an unknown role, a gloss that has one already, and more than kMostSpaceRoles glosses.
SpaceRoles read_space_roles(const std::filesystem::path& path);
/// The same for text; `file` names it in errors.
SpaceRoles read_space_roles_text(const std::string& file, std::string_view text);
inline constexpr std::size_t kMostSpaceRoles = 20'000;
inline constexpr std::size_t kLongestRoleGloss = 1'000;  ///< bytes

/// What words in glosses mean as loci, by their match form in lower case.
using LocusWords = std::map<std::string, LocusRef, std::less<>>;
/// 1 (self), 2 (addressee), 3a (left), 3b (right), the names of the built-in loci, and i, j and k, which an utterance
/// has to set up.
LocusWords usual_locus_words();
/// Reads lines WORD,LOCUS such as `3a,left`, in the same format; these are added to the usual words, or replace them.
LocusWords read_locus_words(const std::filesystem::path& path);
LocusWords read_locus_words_text(const std::string& file, std::string_view text);

}  // namespace signweave
