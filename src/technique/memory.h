#pragma once

#include <mimicry/technique/technique.h>

namespace mimicry {

// What the techniques carry from frame to frame, in model space.

/// Nothing.
struct NoMemory {};

/// Of techniques that look at the frame alone: where to search first.
struct SearchHint {
  Index face = kNone;
  Index tet = kNone;  ///< of the shell
};

/// The last frame that had a point.
struct Anchor {
  bool anchored = false;         ///< there is one: the first point was found
  Vec3 pen = Vec3::Zero();       ///< p
  SurfacePoint surface;          ///< q; also a hint where to search
  Vec3 position = Vec3::Zero();  ///< the same in space
  double time_s = 0.0;
  Index points = 0;            ///< found, not counting those of a pen at rest
  Vec3 motion = Vec3::Zero();  ///< the last motion of the pen that was not zero
  Index tet = kNone;           ///< a hint where to search in the shell
};

/// With the last plane's normal or ray's direction; zero: none yet.
struct DirectedAnchor : Anchor {
  Vec3 direction = Vec3::Zero();
};

/// That may give way: with r - q of the anchor's frame.
struct SoftAnchor : Anchor {
  Vec3 rest = Vec3::Zero();
};

inline Index face_hint(const NoMemory&) {
  return kNone;
}
inline Index face_hint(const SearchHint& hint) {
  return hint.face;
}
inline Index face_hint(const Anchor& anchor) {
  return anchor.surface.face;
}

/// Makes this frame, whose point is `step`'s, the one that the memory knows of.
inline void remember(NoMemory&, const TechniqueStep&, const Frame&) {}
inline void remember(SearchHint& hint, const TechniqueStep& step, const Frame&) {
  hint.face = step.surface.face;
}
void remember(Anchor& anchor, const TechniqueStep& step, const Frame& frame);

/// The step that inks a point; a miss leaves the memory as it was.
template <class OwnMemory>
Stepped<OwnMemory> stepped(const TechniqueStep& step, const OwnMemory& memory, const Frame& frame) {
  Stepped<OwnMemory> result{step, memory};
  if (step.answer != Answer::miss) remember(result.memory, step, frame);
  return result;
}
template <class OwnMemory>
Stepped<OwnMemory> miss(const OwnMemory& memory) {
  return {{}, memory};
}

}  // namespace mimicry
