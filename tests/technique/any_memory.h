#pragma once

#include <string_view>

#include <mimicry/technique/technique.h>

#include "technique/memory.h"

namespace mimicry {

/// What any built-in technique carries, so that one test can look into the memories of all.
struct AnyMemory : Anchor {
  Vec3 direction = Vec3::Zero();
  Vec3 rest = Vec3::Zero();
};
struct AnyStep : TechniqueStep {
  AnyMemory memory;
};

enum class MemoryKind { none, hint, anchor, directed, soft };

inline MemoryKind memory_kind(std::string_view name) {
  if (name == "head-centric") return MemoryKind::none;
  if (name == "mimicry-planar" || name.starts_with("anchored-ray")) return MemoryKind::directed;
  if (name == "mimicry" || name == "mimicry-live") return MemoryKind::soft;
  const TechniqueInfo& info = find_technique(name);
  return info.anchored ? MemoryKind::anchor : MemoryKind::hint;
}

inline Block to_block(MemoryKind kind, const AnyMemory& any) {
  switch (kind) {
    case MemoryKind::none:
      break;
    case MemoryKind::hint:
      return Block::of(SearchHint{any.surface.face, any.tet});
    case MemoryKind::anchor:
      return Block::of<Anchor>(any);
    case MemoryKind::directed:
      return Block::of(DirectedAnchor{any, any.direction});
    case MemoryKind::soft:
      return Block::of(SoftAnchor{any, any.rest});
  }
  return Block::of(NoMemory{});
}

inline AnyMemory from_block(MemoryKind kind, const Block& block) {
  AnyMemory any;
  if (kind == MemoryKind::hint) {
    any.surface.face = block.as<SearchHint>().face;
    any.tet = block.as<SearchHint>().tet;
  } else if (kind == MemoryKind::anchor) {
    static_cast<Anchor&>(any) = block.as<Anchor>();
  } else if (kind == MemoryKind::directed) {
    static_cast<Anchor&>(any) = block.as<DirectedAnchor>();
    any.direction = block.as<DirectedAnchor>().direction;
  } else if (kind == MemoryKind::soft) {
    static_cast<Anchor&>(any) = block.as<SoftAnchor>();
    any.rest = block.as<SoftAnchor>().rest;
  }
  return any;
}

/// A step of the technique as a session takes it; the memory before stays as it is.
inline AnyStep any_step(const TechniqueInfo& info, const Canvas& canvas, const AnyMemory& memory,
                        const Frame& frame, const TechniqueOptions& options = {}) {
  const MemoryKind kind = memory_kind(info.name);
  Block next = to_block(kind, memory);
  const TechniqueStep step = info.step(canvas, frame, options.block(info).data(), next.data());
  return {step, from_block(kind, next)};
}

/// TechniqueOptions with a number set, where the technique has it.
inline TechniqueOptions options_with(const TechniqueInfo& info, std::string_view name,
                                     double value) {
  TechniqueOptions options;
  for (const OptionInfo& option : info.options)
    if (option.name == name) set_option(info, options, name, {&value, 1});
  return options;
}

}  // namespace mimicry
