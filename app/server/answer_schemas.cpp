#include "app/server/openapi.h"

namespace signweave::server {
namespace {

// JSON Schema 2020-12, each answer by its name in the table of routes. What may be missing is not in `required`; more
// properties than are told may come with a later version.
constexpr const char* kDatabaseAnswers = R"json({
  "Databases": {"type": "object", "required": ["databases"], "properties": {
    "databases": {"type": "array", "items": {"type": "object", "required": ["name", "writable", "recordings", "declarations"],
      "properties": {"name": {"type": "string"}, "writable": {"type": "boolean"}, "recordings": {"type": "integer"},
        "declarations": {"$ref": "#/components/schemas/Declarations"}}}}}},
  "Database": {"type": "object",
    "required": ["engine", "engine_version", "entries", "bytes_on_disk", "bytes_free", "layout", "usage", "access_mode", "compact_mm",
                 "weights", "transitions", "recordings"],
    "properties": {
      "engine": {"type": "string"}, "engine_version": {"type": "string"}, "entries": {"type": "integer"},
      "bytes_on_disk": {"type": "integer"},
      "bytes_free": {"type": ["integer", "null"], "description": "of those: what compact-file would give back; null: not known"},
      "layout": {"type": "integer"}, "access_mode": {"type": "string"},
      "compact_mm": {"type": "number", "description": "0: motions are kept to the bit"},
      "documents": {"enum": ["document", "node"], "description": "how annotation is stored that is imported later"},
      "weights": {"$ref": "#/components/schemas/Weights"},
      "transitions": {"type": "object", "description": "what captured movements taught of transitions (docs/synthesis.md)",
        "required": ["learned", "movements", "recordings", "folds", "left_out_by", "mean_ratio", "median_ratio"], "properties": {
          "learned": {"type": "boolean"}, "movements": {"type": "integer"}, "recordings": {"type": "integer"},
          "folds": {"type": "integer"}, "left_out_by": {"enum": ["signer", "recording"]},
          "mean_ratio": {"type": "number"}, "median_ratio": {"type": "number"}}},
      "usage": {"type": "array", "items": {"type": "object", "required": ["kind", "entries", "bytes"],
        "properties": {"kind": {"type": "string"}, "entries": {"type": "integer"}, "bytes": {"type": "integer"}}}},
      "recordings": {"type": "array", "items": {"type": "object",
        "required": ["name", "signer", "motion_file", "annotation_file", "defects", "notices"],
        "properties": {
          "name": {"type": "string"}, "signer": {"type": "string"}, "motion_file": {"type": "string"},
          "annotation_file": {"type": "string"}, "face_file": {"type": "string"}, "defects": {"type": "integer"},
          "notices": {"$ref": "#/components/schemas/Notices"}, "frames": {"type": "integer"},
          "frames_per_second": {"type": "number"}, "joints": {"type": "integer"},
          "tracks": {"type": "array", "items": {"type": "string"}}, "access_mode": {"type": "string"},
          "compact_mm": {"type": "number"}, "packets": {"type": "integer"}}}}}},
  "Weights": {"type": "object", "required": ["join", "target", "speed_limit", "pairs", "comparisons", "folds", "wins",
    "default_wins"], "properties": {
      "join": {"type": "object", "additionalProperties": {"type": "number"}},
      "target": {"type": "object", "additionalProperties": {"type": "number"}}, "speed_limit": {"type": "number"},
      "pairs": {"type": "integer"}, "comparisons": {"type": "integer"}, "folds": {"type": "integer"},
      "wins": {"type": "number"}, "default_wins": {"type": "number"}}},
  "Recording": {"type": "object",
    "required": ["recording", "signer", "motion_file", "face_file", "annotation_file", "annotation_fingerprint",
                 "phases", "phases_measured", "not_measured", "notices"],
    "properties": {
      "recording": {"type": "string"}, "signer": {"type": "string"}, "motion_file": {"type": "string"},
      "face_file": {"type": "string"}, "annotation_file": {"type": "string"},
      "annotation_fingerprint": {"type": "string"}, "frames": {"type": "integer"},
      "frames_per_second": {"type": "number"}, "seconds": {"type": "number"}, "joints": {"type": "integer"},
      "scalar_tracks": {"type": "integer"}, "clock_origin_ms": {"type": "number"}, "phases": {"type": "integer"},
      "phases_measured": {"type": "integer"}, "not_measured": {"type": "string"},
      "shoulder_width_m": {"type": "number"}, "notices": {"$ref": "#/components/schemas/Notices"},
      "rig": {"type": "object", "required": ["convention", "sides_swapped", "parts", "notices"], "properties": {
        "convention": {"type": "string"}, "sides_swapped": {"type": "boolean"},
        "parts": {"type": "object", "additionalProperties": {"type": "object",
          "required": ["joint", "index", "evidence", "confidence"], "properties": {
            "joint": {"type": "string"}, "index": {"type": "integer"}, "evidence": {"type": "string"},
            "confidence": {"type": "number"}, "offset": {"type": "array", "items": {"type": "number"}}}}},
        "notices": {"type": "array", "items": {"type": "string"}}}},
      "defects": {"type": "array", "items": {"type": "object", "required": ["kind", "joint", "value", "text"],
        "properties": {"kind": {"type": "string"}, "joint": {"type": ["string", "null"]}, "value": {"type": "number"},
          "text": {"type": "string"}, "first_frame": {"type": "integer"}, "end_frame": {"type": "integer"}}}}}},
  "Vocabulary": {"type": "object", "required": ["glosses", "tiers", "recordings", "signers", "language"], "properties": {
    "glosses": {"type": "array", "items": {"type": "object", "required": ["gloss", "tokens"], "properties": {
      "gloss": {"type": "string"}, "tokens": {"type": "integer"}}}},
    "tiers": {"type": "array", "items": {"type": "string"}},
    "recordings": {"type": "array", "items": {"type": "string"}},
    "signers": {"type": "array", "items": {"type": "string"}},
    "language": {"type": "object", "additionalProperties": {"type": "array", "items": {"type": "string"}}}}},
  "Labels": {"type": "object", "required": ["tier", "labels", "left_out"], "properties": {
    "tier": {"type": "string"},
    "labels": {"type": "array", "items": {"type": "object", "required": ["label", "annotations"], "properties": {
      "label": {"type": "string"}, "annotations": {"type": "integer"}}}},
    "left_out": {"type": "integer", "description": "labels of fewer annotations that the limit left out"}}},
  "Characters": {"type": "object", "required": ["characters"], "properties": {"characters": {"type": "array",
    "items": {"type": "object", "required": ["name", "file", "height", "face_units"], "properties": {
      "name": {"type": "string"}, "file": {"type": "string"},
      "height": {"type": "number", "description": "metres"},
      "face_units": {"type": "array", "items": {"type": "string"}}}}}}},
  "Media": {"type": "object", "required": ["media"], "properties": {"media": {"type": "array",
    "items": {"type": "object", "required": ["file", "mime", "origin_ms", "url"], "properties": {
      "file": {"type": "string"}, "mime": {"type": "string"},
      "origin_ms": {"type": "integer", "description": "time of the medium at annotation time 0"},
      "url": {"type": ["string", "null"], "description": "null where the server has not got it"}}}}}},
  "RenderedFile": {"type": "object", "required": ["file", "bytes"], "properties": {
    "file": {"type": "string"}, "bytes": {"type": "integer"}}},
  "Check": {"type": "object", "required": ["recordings", "faults"], "properties": {
    "recordings": {"type": "integer"}, "faults": {"type": "array", "items": {"type": "string"}}}},
  "FileFormats": {"type": "array", "items": {"type": "object",
    "required": ["ending", "name", "reads", "writes", "holds", "lost"], "properties": {"ending": {"type": "string"}, "name": {"type": "string"},
      "reads": {"type": "boolean"}, "writes": {"type": "boolean"},
      "holds": {"type": "string"}, "lost": {"type": "string"}}}},
  "OpenApi": {"type": "object", "required": ["openapi", "info", "paths"], "properties": {
    "openapi": {"type": "string"}, "info": {"type": "object"}, "paths": {"type": "object"},
    "components": {"type": "object"}, "servers": {"type": "array"}, "security": {"type": "array"}}},
  "Notices": {"type": "array", "items": {"type": "object", "required": ["where", "text"], "properties": {
    "where": {"type": "string"}, "text": {"type": "string"}, "remedies": {"$ref": "#/components/schemas/Remedies"}}}},
  "Remedies": {"type": "array", "description": "parameters of the call that would fix it: those with a value set together, or one of the others",
    "items": {"type": "object", "required": ["parameter"], "properties": {"parameter": {"type": "string"},
      "value": {"type": "string", "description": "true: a flag; missing: the user has to choose"}}}},
  "Declarations": {"type": "object", "additionalProperties": {"type": "string"},
    "description": "what the recordings say of themselves: whoever shows the answer must show this"},
  "Fault": {"type": "object", "required": ["error"], "properties": {"error": {"type": "object",
    "required": ["code", "message"], "properties": {"code": {"type": "string"},
      "message": {"type": "string", "description": "one line: what is wrong"},
      "remedies": {"$ref": "#/components/schemas/Remedies"},
      "line": {"type": "integer"}, "column": {"type": "integer"},
      "caret": {"type": "string", "description": "of a query: its line, and a caret under the place"},
      "missing": {"type": "array", "description": "glosses of an utterance that no sign has", "items": {"type": "object",
        "required": ["gloss", "matches", "folds"], "properties": {"gloss": {"type": "string"},
          "matches": {"type": "array", "items": {"type": "string"}}, "folds": {"type": "boolean",
            "description": "whether the matches differ in case, accents or width only"}}}},
      "suggestion": {"type": "string", "description": "the utterance with the first match of each"}}}}}
})json";

constexpr const char* kSearchAnswers = R"json({
  "Answers": {"oneOf": [
    {"type": "array", "items": {"type": "object", "required": ["recording", "tier", "name", "begin_ms", "end_ms", "parts"],
      "properties": {"recording": {"type": "string"}, "tier": {"type": "string"}, "name": {"type": "string"}, "begin_ms": {"type": "integer"},
        "end_ms": {"type": "integer"}, "distance": {"type": "number", "minimum": 0},
        "match": {"enum": ["exact", "folded", "sequence", "part", "label", "some"],
          "description": "how it fits, where the text was words only; the better first"},
        "bindings": {"type": "object", "additionalProperties": {"type": "string"}}, "parts": {"type": "array", "items": {"type": "object",
          "required": ["name", "begin_ms", "end_ms"], "properties": {"name": {"type": "string"},
            "begin_ms": {"type": "integer"}, "end_ms": {"type": "integer"}}}}}}},
    {"type": "object", "required": ["plan"], "properties": {"plan": {"type": "string"}}}]},
  "Nodes": {"type": "array", "items": {"type": "object", "required": ["recording", "kind", "value"], "properties": {
    "recording": {"type": "string"},
    "kind": {"enum": ["document", "element", "attribute", "text", "comment", "instruction", "namespace", "string",
      "number", "boolean"]},
    "name": {"type": "string", "description": "of an element or attribute"},
    "value": {"type": ["string", "number", "boolean", "null"], "description": "of a node its text; null is no number"},
    "xml": {"type": "string", "description": "of a node"}}}},
  "Distribution": {"type": "object", "required": ["count"], "properties": {
    "count": {"type": "integer"}, "mean": {"type": "number"}, "sd": {"type": "number"},
    "mean_95": {"type": ["array", "null"], "items": {"type": "number"}}, "least": {"type": "number"},
    "most": {"type": "number"}, "quantiles": {"type": "object", "additionalProperties": {"type": "number"}},
    "histogram": {"type": "object", "required": ["begin", "width", "counts"], "properties": {
      "begin": {"type": "number"}, "width": {"type": "number"},
      "counts": {"type": "array", "items": {"type": "integer"}}}}}},
  "HandTravel": {"type": "object", "required": ["displacement_m", "path_m"], "properties": {
    "displacement_m": {"type": "number"}, "path_m": {"type": "number"}}},
  "TransitionPart": {"type": "object", "required": ["duration_ms"], "properties": {
    "duration_ms": {"$ref": "#/components/schemas/Distribution"},
    "left_hand": {"type": "object"}, "right_hand": {"type": "object"}}},
  "TransitionSummary": {"type": "object", "required": ["inferred", "whole"], "properties": {
    "inferred": {"type": "boolean", "description": "gaps between signs, for no phases are annotated"},
    "whole": {"$ref": "#/components/schemas/TransitionPart"},
    "retraction": {"$ref": "#/components/schemas/TransitionPart"},
    "preparation": {"$ref": "#/components/schemas/TransitionPart"}}},
  "Statistics": {"type": "object", "required": ["all", "recordings"], "properties": {
    "all": {"$ref": "#/components/schemas/TransitionSummary"},
    "recordings": {"type": "array", "items": {"allOf": [{"$ref": "#/components/schemas/TransitionSummary"},
      {"type": "object", "required": ["recording", "signs", "transitions"], "properties": {
        "recording": {"type": "string"}, "signs": {"type": "integer"},
        "transitions": {"type": "array", "items": {"type": "object",
          "required": ["from", "to", "begin_ms", "end_ms", "inferred"], "properties": {
            "from": {"type": "string"}, "to": {"type": "string"}, "begin_ms": {"type": "integer"},
            "end_ms": {"type": "integer"}, "inferred": {"type": "boolean"}, "retraction_ms": {"type": "integer"},
            "preparation_ms": {"type": "integer"}, "left_hand": {"$ref": "#/components/schemas/HandTravel"},
            "right_hand": {"$ref": "#/components/schemas/HandTravel"}}}}}}]}},
    "pairs": {"type": "array", "items": {"allOf": [{"$ref": "#/components/schemas/TransitionSummary"},
      {"type": "object", "required": ["from", "to"], "properties": {
        "from": {"type": "string"}, "to": {"type": "string"}}}]}},
    "glosses": {"type": "array", "items": {"type": "object", "required": ["gloss", "sign_ms", "stroke_ms"],
      "properties": {"gloss": {"type": "string"}, "sign_ms": {"$ref": "#/components/schemas/Distribution"},
        "stroke_ms": {"$ref": "#/components/schemas/Distribution"}}}},
    "ngrams": {"type": "array", "items": {"type": "object", "required": ["glosses", "count", "interval_ms"],
      "properties": {"glosses": {"type": "array", "items": {"type": "string"}}, "count": {"type": "integer"},
        "interval_ms": {"$ref": "#/components/schemas/Distribution"}}}}}},
  "Proposals": {"type": "object", "required": ["recording", "proposed", "hands"], "properties": {
    "recording": {"type": "string"},
    "proposed": {"type": "string", "description": "that a person must check them: show it"},
    "hands": {"type": "object", "required": ["left", "right"], "additionalProperties": {"type": "array",
      "items": {"type": "object", "required": ["phase", "begin_ms", "end_ms", "confidence"], "properties": {
        "phase": {"type": "string"}, "begin_ms": {"type": "integer"}, "end_ms": {"type": "integer"},
        "confidence": {"type": "number"}}}}}}},
  "Evaluation": {"type": "object",
    "required": ["recordings", "recordings_left_out", "left_out_by", "judged", "spans_left_out", "seed", "confidence",
                 "tasks", "spans"],
    "properties": {"recordings": {"type": "integer"}, "recordings_left_out": {"type": "integer"},
      "left_out_by": {"enum": ["collection", "signer", "recording"],
        "description": "nothing is learned from the one that is judged"},
      "judged": {"type": "array", "description": "methods beside kriging, by the wrist's error",
        "items": {"type": "object", "required": ["method", "over", "all", "collections", "may_be_default"],
          "properties": {"method": {"type": "string"}, "over": {"type": "string"}, "all": {"type": "object"},
            "collections": {"type": "array", "items": {"type": "object"}}, "may_be_default": {"type": "boolean"}}}},
      "spans_left_out": {"type": "integer"}, "seed": {"type": "integer"}, "confidence": {"type": "number"},
      "tasks": {"type": "array", "items": {"type": "object", "required": ["task", "groups"], "properties": {
        "task": {"type": "string"}, "groups": {"type": "array", "items": {"type": "object"}}}}},
      "spans": {"type": "array", "items": {"type": "object"}},
      "plot": {"type": "string", "description": "the summary with intervals, an SVG document"},
      "declarations": {"$ref": "#/components/schemas/Declarations"},
      "notices": {"$ref": "#/components/schemas/Notices"}}}
})json";

constexpr const char* kMadeAnswers = R"json({
  "Span": {"type": "object", "required": ["begin_ms", "end_ms"], "properties": {
    "begin_ms": {"type": "integer"}, "end_ms": {"type": "integer"}}},
  "Frames": {"type": "object", "required": ["begin", "end"], "properties": {
    "begin": {"type": "integer"}, "end": {"type": "integer", "description": "the one after the last"}}},
  "PlaceId": {"type": "integer", "minimum": 0,
    "description": "the first place of the utterance that it is of, counted from 0; of a junction the one after it"},
  "ClipId": {"type": "integer", "minimum": 0, "description": "of the score's clips"},
  "Synthesis": {"type": "object",
    "required": ["frames", "frames_per_second", "signs", "stretches", "junctions", "timings", "declarations",
                 "notices"],
    "properties": {
      "frames": {"type": "integer"}, "frames_per_second": {"type": "number"},
      "signs": {"type": "array", "items": {"type": "object",
        "required": ["gloss", "place", "clip", "recording", "begin_ms", "end_ms", "recorded", "phases"], "properties": {
          "gloss": {"type": "string"}, "place": {"$ref": "#/components/schemas/PlaceId"},
          "clip": {"$ref": "#/components/schemas/ClipId"}, "recording": {"type": "string"}, "begin_ms": {"type": "integer"},
          "end_ms": {"type": "integer"}, "recorded": {"$ref": "#/components/schemas/Span"},
          "phases": {"type": "array", "items": {"type": "object", "required": ["kind", "begin_ms", "end_ms"]}}}}},
      "stretches": {"type": "array", "items": {"type": "object", "required": ["clip", "place", "recording", "frames",
        "kept_frames", "kept_from_recorded_frame", "recorded_frames_per_frame"], "properties": {
          "clip": {"$ref": "#/components/schemas/ClipId"}, "place": {"$ref": "#/components/schemas/PlaceId"},
          "recording": {"type": "string"}, "frames": {"$ref": "#/components/schemas/Frames"},
          "kept_frames": {"$ref": "#/components/schemas/Frames"}, "kept_from_recorded_frame": {"type": "number"},
          "recorded_frames_per_frame": {"type": "number"}}}},
      "junctions": {"type": "array", "items": {"type": "object", "required": ["number", "place", "from_clip", "to_clip", "from", "to",
        "method", "frames", "retraction_frames", "preparation_frames", "blend_frames", "parts"], "properties": {
          "number": {"type": "integer", "minimum": 1, "description": "by which `junctions` names it"},
          "place": {"$ref": "#/components/schemas/PlaceId"}, "from_clip": {"$ref": "#/components/schemas/ClipId"},
          "to_clip": {"$ref": "#/components/schemas/ClipId"},
          "from": {"type": "string"}, "to": {"type": "string"}, "method": {"type": "string"},
          "frames": {"$ref": "#/components/schemas/Frames"}, "retraction_frames": {"type": "integer"},
          "preparation_frames": {"type": "integer"}, "blend_frames": {"type": "integer"},
          "parts": {"type": "object"},
          "chosen": {"type": "object", "description": "what `junctions` told of it", "properties": {
            "method": {"type": "string"}, "duration_ms": {"type": "integer"}, "tempo": {"type": "number"}}}}}},
      "timings": {"type": "object", "additionalProperties": {"type": "number"}},
      "places": {"type": "array", "items": {"type": "object", "required": ["candidates", "chosen", "join_cost"]}},
      "weights": {"$ref": "#/components/schemas/Weights"}, "captured_transitions": {"type": "integer"},
      "declarations": {"$ref": "#/components/schemas/Declarations"},
      "notices": {"$ref": "#/components/schemas/Notices"}}},
  "FramePair": {"type": "array", "items": {"type": "integer", "minimum": 0}, "minItems": 2, "maxItems": 2,
    "description": "the first, and the one after the last"},
  "ScoreSource": {"type": "object", "required": ["recording", "fingerprint"], "properties": {
    "recording": {"type": "string"},
    "fingerprint": {"type": "string", "description": "of its motion file, hexadecimal; 0: not known"},
    "kind": {"type": "string", "enum": ["recording", "rest", "shown"]}}},
  "Score": {"type": "object",
    "required": ["signweave_score", "skeleton", "rate", "frames", "clips", "junctions", "lanes"],
    "properties": {
      "signweave_score": {"type": "integer", "minimum": 1, "description": "the version of the form"},
      "skeleton": {"$ref": "#/components/schemas/ScoreSource"},
      "rate": {"type": "array", "items": {"type": "integer", "minimum": 1}, "minItems": 2, "maxItems": 2},
      "frames": {"type": "integer", "minimum": 1},
      "clips": {"type": "array", "minItems": 1, "items": {"type": "object",
        "required": ["id", "place", "source", "whole", "core", "step", "at", "standing", "clock", "signs"],
        "properties": {
          "id": {"$ref": "#/components/schemas/ClipId"}, "place": {"$ref": "#/components/schemas/PlaceId"},
          "source": {"$ref": "#/components/schemas/ScoreSource"},
          "whole": {"$ref": "#/components/schemas/FramePair"}, "core": {"$ref": "#/components/schemas/FramePair"},
          "step": {"type": "number"}, "at": {"$ref": "#/components/schemas/FramePair"},
          "standing": {"type": ["object", "null"]}, "clock": {"type": "object", "required": ["frame_time", "origin"]},
          "signs": {"type": "array", "items": {"type": "object", "required": ["place", "gloss", "ms", "hand", "signer",
            "tier", "annotation", "inferred", "phases"]}}}}},
      "junctions": {"type": "array", "items": {"type": "object", "required": ["number", "method", "chosen"],
        "properties": {"number": {"type": "integer"}, "method": {"type": "string"}, "chosen": {"type": "string"}}}},
      "lanes": {"type": "array", "items": {"type": "object", "required": ["channel", "items"], "properties": {
        "channel": {"type": "string", "enum": ["body", "left", "right", "tracks"]},
        "items": {"type": "array", "items": {"type": "object", "required": ["at"], "properties": {
          "at": {"$ref": "#/components/schemas/FramePair"}, "clip": {"$ref": "#/components/schemas/ClipId"},
          "transition": {"type": "object", "required": ["from", "to", "length", "retraction", "preparation", "blend",
            "pause", "waits"]}}}}}}}}},
  "Removed": {"type": "object", "required": ["removed"], "properties": {"removed": {"type": "string"}}},
  "Upload": {"type": "object", "required": ["upload", "files"], "properties": {"upload": {"type": "string"},
    "files": {"type": "array", "items": {"type": "object", "required": ["file", "bytes"], "properties": {
      "file": {"type": "string"}, "bytes": {"type": "integer"}}}}}},
  "UploadedFile": {"type": "object", "required": ["file", "bytes", "upload_bytes"], "properties": {
    "file": {"type": "string"}, "bytes": {"type": "integer"}, "upload_bytes": {"type": "integer"}}},
  "Discarded": {"type": "object", "required": ["discarded"], "properties": {"discarded": {"type": "string"}}},
  "JobBegun": {"type": "object", "required": ["job"], "properties": {"job": {"type": "string"}}},
  "Changed": {"type": "object", "properties": {
    "recordings": {"description": "of an import what became of each, of an inspect what it would become, as far as it is; of a relayout how many"},
    "changed": {"type": "array", "items": {"type": "string"}}, "notices": {"$ref": "#/components/schemas/Notices"},
    "faults": {"type": "array", "items": {"type": "string"}}}},
  "Job": {"type": "object", "required": ["job", "kind", "database", "state", "fraction"], "properties": {
    "job": {"type": "string"}, "kind": {"enum": ["inspect", "import", "relayout", "evaluate"]}, "database": {"type": "string"},
    "state": {"enum": ["waiting", "running", "done", "failed", "cancelled"]},
    "fraction": {"type": "number", "minimum": 0, "maximum": 1},
    "result": {"anyOf": [{"$ref": "#/components/schemas/Changed"}, {"$ref": "#/components/schemas/Evaluation"}]},
    "error": {"type": "object", "required": ["code", "message"]}}},
  "Jobs": {"type": "object", "required": ["jobs"], "properties": {
    "jobs": {"type": "array", "description": "without their results", "items": {"$ref": "#/components/schemas/Job"}}}}
})json";

}  // namespace

nlohmann::ordered_json answer_schemas() {
  nlohmann::ordered_json schemas = nlohmann::ordered_json::object();
  for (const char* text : {kDatabaseAnswers, kSearchAnswers, kMadeAnswers}) {
    const nlohmann::ordered_json some = nlohmann::ordered_json::parse(text);
    for (const auto& [name, schema] : some.items()) schemas[name] = schema;
  }
  return schemas;
}

}  // namespace signweave::server
