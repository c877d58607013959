#pragma once

/// The library, for programs that use it: `find_package(signweave)`, link `signweave::signweave`, include this.
/// examples/quickstart.cpp takes a folder of recordings to a signed utterance. What is installed is this header and
/// what it includes.

#include "signweave/choose/edit.h"              // change a recording's signing
#include "signweave/choose/known_words.h"       // the glosses of a database, for reading utterances
#include "signweave/choose/open_score.h"        // render a score again
#include "signweave/choose/synthesizer.h"       // an utterance -> a score and its motion
#include "signweave/core/atomic_file.h"         // read_file; files that are written atomically
#include "signweave/database/database.h"        // recordings: put, find, read, remove
#include "signweave/database/import.h"          // files -> recordings
#include "signweave/formats/annotation_file.h"  // EAF, ANVIL
#include "signweave/formats/motion_file.h"      // BVH, glTF, FBX, ASF/AMC
#include "signweave/formats/write_file.h"       // save a synthesis or a recording in any format that is written
#include "signweave/live/player.h"              // sign an utterance while it grows
#include "signweave/notation/score_json.h"      // a score as JSON
#include "signweave/notation/utterance.h"       // "DEMAIN MATIN#2 PLUIE"
#include "signweave/query/parse.h"              // the query language
#include "signweave/retarget/retarget.h"        // a motion on another body
