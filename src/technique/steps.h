#pragma once

#include <mimicry/technique/technique.h>

#include "technique/memory.h"
#include "technique/options.h"

namespace mimicry {

// Context-free techniques (paper, section 3.1).
Stepped<SearchHint> occlude(const Canvas&, const SearchHint&, const Frame&, const SightOptions&);
Stepped<SearchHint> spraycan(const Canvas&, const SearchHint&, const Frame&, const SprayOptions&);
Stepped<NoMemory> head_centric(const Canvas&, const NoMemory&, const Frame&, const NoOptions&);
Stepped<SearchHint> snap(const Canvas&, const SearchHint&, const Frame&, const NoOptions&);
Stepped<SearchHint> snap_smooth(const Canvas&, const SearchHint&, const Frame&,
                                const SmoothClosestOptions&);

// Anchored techniques (paper, section 4).
Stepped<Anchor> anchored_closest(const Canvas&, const Anchor&, const Frame&, const SprayOptions&);
Stepped<SoftAnchor> mimicry(const Canvas&, const SoftAnchor&, const Frame&, const MimicryOptions&);
Stepped<DirectedAnchor> mimicry_planar(const Canvas&, const DirectedAnchor&, const Frame&,
                                       const SprayOptions&);
Stepped<Anchor> mimicry_offset(const Canvas&, const Anchor&, const Frame&,
                               const SpraySmoothOptions&);
Stepped<Anchor> mimicry_parallel(const Canvas&, const Anchor&, const Frame&,
                                 const SpraySmoothOptions&);
Stepped<DirectedAnchor> anchored_ray_plane(const Canvas&, const DirectedAnchor&, const Frame&,
                                           const SprayOptions&);
Stepped<DirectedAnchor> anchored_ray_transport(const Canvas&, const DirectedAnchor&, const Frame&,
                                               const SprayOptions&);

// Anchored, without a bake (ours).
Stepped<SoftAnchor> mimicry_live(const Canvas&, const SoftAnchor&, const Frame&,
                                 const SoftAnchorOptions&);

/// Of a motion, along an axis: squares of what is farther overflow.
inline constexpr double kFarthestHand = 1e60;

}  // namespace mimicry
