#pragma once

#include <cassert>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>

#include "app/calls/field.h"

namespace signweave::server {

/// A call's file is named by its plain name in the upload whose folder this is: makes a path of it. Nothing for an
/// empty name. Throws Error{bad_input} for what is no plain file name, Error{not_found}.
void resolve(std::string& file, const std::filesystem::path& folder, std::string_view field);

/// Does so with every field of a call that names a file, whatever fields it has.
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

/// Takes the server's folder out of a text, or out of every text of a JSON value: nobody needs to know of it.
std::string without_folder(std::string text, const std::string& folder);
nlohmann::json without_folder(nlohmann::json value, const std::string& folder);

}  // namespace signweave::server
