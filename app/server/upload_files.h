#pragma once

#include <cassert>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>

#include "signweave/calls/field.h"

namespace signweave::server {

/// Replaces the plain name of a file by its path in `folder`, the folder of the upload. Leaves an empty name unchanged.
/// Throws Error{bad_input} if it is not a plain file name, Error{not_found}.
void resolve(std::string& file, const std::filesystem::path& folder, std::string_view field);

/// Resolves every field of a call that names a file, for any call.
struct ResolveFiles {
  const std::filesystem::path& folder;

  template <class Member>
  void operator()(const calls::Field& field, Member& member) const {
    if constexpr (std::is_same_v<Member, std::string>) {
      if (field.is_file) resolve(member, folder, field.name);
    } else {
      assert(!field.is_file);
    }
  }
};

/// Removes the server's folder from a text, or from every text of a JSON value: clients need not know it.
std::string without_folder(std::string text, const std::string& folder);
nlohmann::json without_folder(nlohmann::json value, const std::string& folder);

}  // namespace signweave::server
