#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "signweave/core/text.h"
#include "signweave/database/catalogue.h"
#include "signweave/database/change_steps.h"
#include "signweave/database/database.h"
#include "signweave/database/measure.h"
#include "signweave/database/movement.h"
#include "signweave/database/tables.h"
#include "signweave/motion_db/quantise.h"
#include "signweave/semantic_db/semantic_db.h"
#include "signweave/semantic_db/table_store.h"
#include "signweave/semantic_db/trace_store.h"

// Changes of a database; database_put.cpp stores a recording. A motion is first written under a new generation, which
// no recording refers to; then one transaction makes it visible and puts the replaced motion on the sweep list. So a
// crash leaves either the old or the new motion, and leftovers to sweep.

namespace signweave {

namespace {

void require_tolerance(float tolerance) {
  if (tolerance >= 0 && std::isfinite(tolerance)) return;
  throw Error(ErrorCode::bad_input, "a tolerance must be 0 or a length in metres");
}

}  // namespace

void Database::create(const std::filesystem::path& folder, const CreateOptions& options) {
  require_tolerance(options.tolerance);
  kv::create(folder, options.engine);
  const std::unique_ptr<kv::KvStore> store = kv::open(folder, kv::Access::read_write);
  const std::unique_ptr<kv::WriteTransaction> transaction = store->write();
  catalogue::write_head(
      *transaction,
      {.access_mode = options.access_mode, .tolerance = options.tolerance, .documents = options.documents});
  transaction->commit();
}

void Database::require_writable() const {
  if (access_ != kv::Access::read_write) {
    throw Error(ErrorCode::conflict, folder_.string() + ": was opened for reading only");
  }
  // Cached data holds snapshots of the old state, whose space in the file could not be reused.
  const std::lock_guard guard(mutex_);
  contents_.reset();
  segments_.reset();
}

namespace {

/// Throws Error{io} unless the stored motion reads back bit for bit.
void verify(const kv::ReadTransaction& snapshot, const motion_db::StoredMotion& stored, const Motion& motion) {
  // Some thousand frames at a time, in whole packets: no packet is read twice, and a motion cut into packets of frames
  // is not held in memory twice.
  constexpr std::int64_t kFrames = 4096;
  const std::int64_t p = stored.mode.frames_per_packet;
  const std::int64_t step = p > 0 ? (kFrames + p - 1) / p * p : stored.frames;
  const std::shared_ptr<const Skeleton> skeleton = motion_db::read_skeleton(snapshot, stored);
  for (std::int64_t begin = 0; begin < stored.frames; begin += step) {
    const FrameRange frames{begin, std::min(begin + step, stored.frames)};
    if (same_bits(motion_db::read(snapshot, stored, skeleton, frames), motion.slice(frames))) continue;
    throw Error(ErrorCode::io, fmt::format("stored motion {}: frames [{}, {}) do not read back as they were written; "
                                           "check memory and disk, and try again",
                                           stored.generation, frames.begin, frames.end));
  }
}

}  // namespace

SegmentChunk segments_if_sound(const kv::ReadTransaction& snapshot, const RecordingInfo& info) {
  try {
    return semantic_db::read_segments(snapshot, info.document, info.name);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt) throw;
    return {};
  }
}

Database::Progress part_of(const Database::Progress& whole, double from, double to) {
  if (!whole) return {};
  return [&whole, from, to](double fraction) { whole(from + fraction * (to - from)); };
}

void make_visible(kv::WriteTransaction& transaction, RecordingInfo& info, const motion_db::StoredMotion& stored) {
  catalogue::SweepList list = catalogue::read_sweep_list(transaction);
  std::erase_if(list, [&](const motion_db::StoredMotion& one) { return one.generation == stored.generation; });
  if (info.motion) list.push_back(*info.motion);
  catalogue::write_sweep_list(transaction, list);
  info.motion = stored;
}

motion_db::StoredMotion Database::write_motion(const Motion& motion, AccessMode mode, float tolerance,
                                               const Progress& progress) {
  motion_db::StoredMotion stored = motion_db::describe(motion, mode, 0, tolerance);
  {
    const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
    catalogue::Head head = catalogue::read_head(*transaction);
    stored.generation = head.next_generation++;
    catalogue::write_head(*transaction, head);
    // The motion is on the sweep list before its first packet is written and until it becomes visible: the next open
    // sweeps what a crash in between leaves.
    catalogue::SweepList list = catalogue::read_sweep_list(*transaction);
    list.push_back(stored);
    catalogue::write_sweep_list(*transaction, list);
    transaction->commit();
  }
  try {
    motion_db::put(*store_, stored, motion, progress);
    verify(*store_->read(), stored, motion);
  } catch (...) {
    try {
      sweep();
    } catch (const Error&) {  // the disk may be full: the next open sweeps
    }
    throw;
  }
  return stored;
}

void Database::remember_slot(std::uint32_t slot, const std::string& name, std::uint64_t changes) {
  const std::lock_guard guard(mutex_);
  if (slots_at_ != changes - 1) return;  // another thread has already read the names again
  if (slot == slots_.size()) slots_.emplace_back();
  slots_[slot] = name;
  slots_at_ = changes;
}

bool Database::relayout(std::string_view name, const Storage& to, const Progress& progress) {
  require_writable();
  std::optional<motion_db::StoredMotion> stored;
  {
    const std::unique_ptr<kv::ReadTransaction> snapshot = store_->read();
    const RecordingInfo info = recording_in(*snapshot, name);
    if (!info.motion) return false;
    const motion_db::StoredMotion& old = *info.motion;
    const float tolerance = to.tolerance.value_or(old.tolerance);
    if (old.tolerance > 0 && tolerance != old.tolerance) {
      throw Error(
          ErrorCode::conflict,
          fmt::format("was rounded within {:.6g} mm when it was stored, and what that dropped is gone; import its "
                      "motion file again into a database that stores motions exactly",
                      1e3 * old.tolerance),
          {{"replace_motion", "true"}});
    }
    const std::shared_ptr<const Skeleton> skeleton = motion_db::read_skeleton(*snapshot, old);
    AccessMode mode = to.mode.value_or(old.mode);
    if (!to.mode && old.mode == motion_db::fitted({old.mode.kind, 0}, *skeleton, old.tolerance)) {
      mode.frames_per_packet = 0;  // it was the default, so the new packets get their own default
    }
    if (motion_db::fitted(mode, *skeleton, tolerance) == old.mode && tolerance == old.tolerance) return false;
    Motion motion = motion_db::read(*snapshot, old, skeleton, {0, old.frames});
    const bool rounds = tolerance != old.tolerance;
    if (rounds) motion = motion_db::quantise(motion, tolerance, part_of(progress, 0, 0.5));
    stored = write_motion(motion, mode, tolerance, part_of(progress, rounds ? 0.5 : 0, 1));
  }

  const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
  catalogue::Head head = catalogue::read_head(*transaction);
  const std::uint32_t slot = slot_of(*transaction, name).value();
  RecordingInfo info = catalogue::read_recording(*transaction, slot);
  const bool rounded = info.motion->tolerance != stored->tolerance;
  make_visible(*transaction, info, *stored);
  if (rounded && info.document != 0) {
    const SegmentChunk segments = segments_if_sound(*transaction, info);
    semantic_db::put_features(*transaction, info.document, measure_stored(*transaction, info, segments));
    semantic_db::erase_trace(*transaction, info.document);
    semantic_db::put_trace(*transaction, info.document, trace_stored(*transaction, info));
  }
  catalogue::write_recording(*transaction, slot, info);
  ++head.changes;
  catalogue::write_head(*transaction, head);
  transaction->commit();
  remember_slot(slot, info.name, head.changes);
  sweep();
  return true;
}

void Database::set_storage(const Storage& storage) {
  require_writable();
  require_tolerance(storage.tolerance.value_or(0));
  const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
  catalogue::Head head = catalogue::read_head(*transaction);
  head.access_mode = storage.mode.value_or(head.access_mode);
  head.tolerance = storage.tolerance.value_or(head.tolerance);
  catalogue::write_head(*transaction, head);
  transaction->commit();
}

std::optional<std::uint32_t> Database::damaged_slot(const kv::ReadTransaction& snapshot, std::string_view name) const {
  const std::uint32_t recordings = catalogue::read_head(snapshot).recordings;
  for (std::uint32_t slot = 0; slot < recordings; ++slot) {
    if (name != fmt::format("catalogue entry {}", slot)) continue;
    try {
      catalogue::read_recording(snapshot, slot);
    } catch (const Error&) {
      return slot;
    }
  }
  return std::nullopt;
}

void Database::remove(std::string_view name) {
  require_writable();
  const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
  std::optional<std::uint32_t> slot = slot_of(*transaction, name);
  const bool damaged = !slot && (slot = damaged_slot(*transaction, name)).has_value();
  if (!slot) contents()->at(name);  // throws the error with near matches
  if (!slot) throw Error(ErrorCode::not_found, fmt::format("no recording '{}' in this database", printable(name)));
  catalogue::Head head = catalogue::read_head(*transaction);
  const RecordingInfo info = damaged ? RecordingInfo{} : catalogue::read_recording(*transaction, *slot);
  if (info.document != 0) semantic_db::erase(*transaction, info.document);
  if (info.motion) {
    catalogue::SweepList list = catalogue::read_sweep_list(*transaction);
    list.push_back(*info.motion);
    catalogue::write_sweep_list(*transaction, list);
  }
  const std::uint32_t last = head.recordings - 1;
  if (*slot != last) {
    catalogue::move_recording(*transaction, last, *slot);
  } else {
    catalogue::erase_recording(*transaction, last);
  }
  --head.recordings;
  ++head.changes;
  catalogue::write_head(*transaction, head);
  tables::remove(*transaction, info.name);
  transaction->commit();
  sweep();
  if (damaged) sweep_unnamed();  // a damaged entry does not say which records were its own
}

void Database::sweep() {
  for (;;) {
    catalogue::SweepList list;
    try {
      list = catalogue::read_sweep_list(*store_->read());
    } catch (const Error& error) {
      if (error.code() != ErrorCode::corrupt) throw;
      sweep_unnamed();  // the damaged list cannot be read, so search all records
      const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
      catalogue::write_sweep_list(*transaction, {});
      transaction->commit();
      return;
    }
    if (list.empty()) return;
    try {
      motion_db::erase(*store_, list.back());
    } catch (const Error& error) {
      // A motion on damaged pages cannot be erased. It is dropped from the list: no recording refers to it, and it must
      // not block every later change.
      if (error.code() != ErrorCode::corrupt) throw;
    }
    const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
    catalogue::SweepList rest = catalogue::read_sweep_list(*transaction);
    std::erase(rest, list.back());
    catalogue::write_sweep_list(*transaction, rest);
    transaction->commit();
  }
}

void Database::sweep_unnamed() {
  std::set<std::uint64_t> named;
  {
    const std::unique_ptr<kv::ReadTransaction> snapshot = store_->read();
    const std::uint32_t recordings = catalogue::read_head(*snapshot).recordings;
    for (std::uint32_t slot = 0; slot < recordings; ++slot) {
      try {
        const RecordingInfo info = catalogue::read_recording(*snapshot, slot);
        if (info.motion) named.insert(info.motion->generation);
        if (info.document != 0) named.insert(info.document);
      } catch (const Error&) {
        return;  // records of a damaged entry cannot be identified and may still be needed
      }
    }
  }
  try {
    const std::vector<std::uint64_t> listed = semantic_db::table_generations(*store_->read());
    named.insert(listed.begin(), listed.end());
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt) throw;  // no reader can find the tables then
  }
  std::vector<Bytes> unnamed;
  store_->visit([&](ByteSpan key, std::size_t) {
    std::optional<std::uint64_t> generation = motion_db::generation_of(key);
    if (!generation) generation = semantic_db::generation_of(key);
    if (generation && !named.contains(*generation)) unnamed.emplace_back(key.begin(), key.end());
  });
  constexpr std::size_t kMostErased = 512;  // in one transaction, as in motion_db
  for (std::size_t i = 0; i < unnamed.size(); i += kMostErased) {
    const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
    for (std::size_t k = i; k < std::min(i + kMostErased, unnamed.size()); ++k) transaction->erase(unnamed[k]);
    transaction->commit();
  }
}

}  // namespace signweave
