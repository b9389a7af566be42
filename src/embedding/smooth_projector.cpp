#include <mimicry/embedding/smooth_projector.h>

#include "embedding/projection.h"

namespace mimicry {

SmoothProjector::SmoothProjector(Embedding embedding, const Target& target)
    : projection_(std::make_shared<const SmoothProjection>(std::move(embedding), target)) {}

std::optional<SmoothPoint> SmoothProjector::project(const Vec3& y, const ScpOptions& options,
                                                    ScpHint* hint) const {
  return projection_->project(y, options, hint);
}

std::optional<SmoothPoint> SmoothProjector::project_exhaustively(const Vec3& y,
                                                                 const ScpOptions& options) const {
  return projection_->project_exhaustively(y, options);
}

SmoothPoint SmoothProjector::weighted_average(std::span<const SurfacePoint> points,
                                              std::span<const double> weights,
                                              Index face_hint) const {
  return projection_->weighted_average(points, weights, face_hint);
}

const Target& SmoothProjector::target() const {
  return projection_->target();
}

const Embedding& SmoothProjector::embedding() const {
  return projection_->embedding();
}

std::size_t SmoothProjector::memory_bytes() const {
  return projection_->memory_bytes();
}

}  // namespace mimicry
