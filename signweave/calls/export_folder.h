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
  std::vector<std::string> recordings;  ///< names; empty: all
  std::vector<std::string> extensions;  ///< ".bvh", …, of the files to write; empty: those that import reads back
  std::filesystem::path folder;         ///< created if it does not exist
  ExportCall call;                      ///< what to export of each; its `recording` is ignored
};

struct FolderExported {
  std::size_t recordings = 0;
  std::vector<std::string> files;  ///< paths, in the order in which they were written
  Declarations declarations;       ///< of the recordings, each once
};

/// A file name for a recording: characters that a file system may refuse become '_'. Two recordings may get the same
/// file name.
std::string file_name_of(const std::string& recording);

/// Writes for each recording the files it has content for (an annotation for .eaf, scalar tracks for .face.csv, else a
/// motion), and `pairs.csv`, with which `import --pairs` reads them all back: names, signers, clocks. Existing files
/// are replaced, each atomically. Throws, before anything is written, Error{not_found} for an unknown recording or for
/// a joint or tier that no recording has, and Error{bad_input} for an extension without a writer; and Error{io}.
FolderExported run(const Database& database, const FolderExport& call, const Listener& listener);

template <class Visit>
void fields(Visit& visit, const FolderExported& done) {
  visit.type("FolderExported");
  visit(AnswerField{.name = "recordings"}, done.recordings);
  visit(AnswerField{.name = "files"}, done.files);
}

}  // namespace signweave::calls
