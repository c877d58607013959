#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "signweave/annotation/declarations.h"
#include "signweave/calls/export_call.h"
#include "signweave/calls/listener.h"

namespace signweave::calls {

/// Writes several recordings, or all, as files into one folder.
struct FolderExport {
  std::vector<std::string> recordings;  ///< names; none: all
  std::vector<std::string> extensions;  ///< ".bvh", …: of the files of each; none: what import reads it back from
  std::filesystem::path folder;         ///< made where it is missing
  ExportCall call;                      ///< what of each; its `recording` is not looked at
};

struct FolderExported {
  std::size_t recordings = 0;
  std::vector<std::string> files;  ///< paths, in the order in which they were written
  Declarations declarations;       ///< of the recordings, each once
};

/// A name for a file of a recording: what a file system may refuse in it is '_'. The same of two different names.
std::string file_name_of(const std::string& recording);

/// Of each recording the files that it has something for (an annotation for .eaf, scalar tracks for .face.csv, else a
/// motion), and `pairs.csv`, by which `import --pairs` takes them all again: names, signers, clocks. Files that are
/// there are replaced, each whole or not at all. Throws Error{not_found} for a recording, joint or tier that no
/// recording has, Error{bad_input} for an extension that has no writer, before anything is written; and Error{io}.
FolderExported run(const Database& database, const FolderExport& call, const Listener& listener);

template <class Visit>
void fields(Visit& visit, const FolderExported& done) {
  visit.type("FolderExported");
  visit(AnswerField{.name = "recordings"}, done.recordings);
  visit(AnswerField{.name = "files"}, done.files);
}

}  // namespace signweave::calls
