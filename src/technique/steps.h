#pragma once

#include <mimicry/technique/technique.h>

namespace mimicry::technique {

// Context-free techniques (paper, section 3.1).
Step occlude(const Canvas&, const Memory&, const stroke::Frame&, const Options&);
Step spraycan(const Canvas&, const Memory&, const stroke::Frame&, const Options&);
Step head_centric(const Canvas&, const Memory&, const stroke::Frame&, const Options&);
Step snap(const Canvas&, const Memory&, const stroke::Frame&, const Options&);
Step snap_smooth(const Canvas&, const Memory&, const stroke::Frame&, const Options&);

// Anchored techniques (paper, section 4).
Step anchored_closest(const Canvas&, const Memory&, const stroke::Frame&, const Options&);
Step mimicry(const Canvas&, const Memory&, const stroke::Frame&, const Options&);
Step mimicry_planar(const Canvas&, const Memory&, const stroke::Frame&, const Options&);
Step mimicry_offset(const Canvas&, const Memory&, const stroke::Frame&, const Options&);
Step mimicry_parallel(const Canvas&, const Memory&, const stroke::Frame&, const Options&);
Step anchored_ray_plane(const Canvas&, const Memory&, const stroke::Frame&, const Options&);
Step anchored_ray_transport(const Canvas&, const Memory&, const stroke::Frame&, const Options&);

// Anchored, without a bake (ours).
Step mimicry_live(const Canvas&, const Memory&, const stroke::Frame&, const Options&);

/// Of a motion, along an axis: squares of what is farther overflow.
inline constexpr double kFarthestHand = 1e60;

/// The step that inks q for this frame: the frame becomes the anchor.
Step ink(Answer answer, const SurfacePoint& surface, const Vec3& position, const Memory& memory,
         const stroke::Frame& frame);
/// No point; the anchor stays.
Step miss(const Memory& memory);

}  // namespace mimicry::technique
