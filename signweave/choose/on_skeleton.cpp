#include "signweave/choose/on_skeleton.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <optional>

#include "signweave/retarget/retargeted_source.h"

namespace signweave {

bool have_same_joints(const std::shared_ptr<const Skeleton>& a, const std::shared_ptr<const Skeleton>& b) {
  return a == b || !difference(*a, *b);
}

void require_same_joints(const std::string& reference, const std::shared_ptr<const Skeleton>& joints,
                         const MotionClip& clip) {
  if (have_same_joints(joints, clip.source->skeleton())) return;
  throw Error(ErrorCode::bad_input,
              fmt::format("recordings '{}' and '{}' have different skeletons: {}; only motions with the same joints "
                          "can be joined",
                          reference, clip.recording, *difference(*joints, *clip.source->skeleton())));
}

RecordedBody body_of(const Contents& contents, const std::string& recording, const MotionSource& source) {
  return recorded_body(recording, source, contents.at(recording).rig);
}

void put_on_skeleton(std::vector<MotionClip>& clips, const std::string& reference, const MotionSource& home,
                     const Contents& contents, std::vector<Notice>& notices) {
  std::optional<RecordedBody> target;
  std::map<std::string, std::shared_ptr<const MotionSource>> mapped;  // by recording
  for (MotionClip& clip : clips) {
    if (have_same_joints(clip.source->skeleton(), home.skeleton())) continue;
    if (clip.kind != SourceRef::Kind::recording) require_same_joints(reference, home.skeleton(), clip);
    std::shared_ptr<const MotionSource>& source = mapped[clip.recording];
    if (!source) {
      if (!target) target = body_of(contents, reference, home);
      const auto mapping =
          std::make_shared<const BodyMapping>(map_body(body_of(contents, clip.recording, *clip.source), *target));
      notices.insert(notices.end(), mapping->notices.begin(), mapping->notices.end());
      source = std::make_shared<RetargetedSource>(clip.source, mapping);
    }
    clip.source = source;
    clip.noise = nullptr;
  }
}

}  // namespace signweave
