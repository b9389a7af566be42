#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <mimicry/curve/projected_curve.h>
#include <mimicry/paint/atlas.h>
#include <mimicry/paint/layers.h>
#include <mimicry/paint/stamp.h>

namespace mimicry {

enum class BrushBlend : std::uint8_t {
  build,  ///< dabs add up: A = 1 - product of (1 - alpha k)
  max     ///< the largest of flow times k, without dabs: even along the curve
};

/// A round brush. k(d) of a dab at distance d from its centre, in radii along the surface, is
/// 1 - smoothstep((d - hardness) / (1 - hardness)), never steeper than over one texel.
struct Brush {
  double radius = 0.0;    ///< > 0, model units; infinity covers what is connected
  double hardness = 0.8;  ///< 0 to 1
  /// 0 to 1: what a hard brush covers in the middle of a stroke, whatever the spacing is: each dab
  /// has alpha = 1 - (1 - flow)^spacing.
  double flow = 1.0;
  double opacity = 1.0;  ///< 0 to 1: what a stroke covers at most
  double spacing = 0.1;  ///< of dabs, in diameters, 0.01 to 1; 1 / spacing best a whole number
  BrushBlend blend = BrushBlend::build;
  /// How far pressure 0 takes away from radius and flow, 0 to 1; pressure 1 takes nothing.
  double pressure_size = 0.0;
  double pressure_flow = 0.0;
  Rgb8 color = {0, 0, 0};
  bool erase = false;
};

/// Throws Error(invalid_input) that names the first value out of range and what it may be.
void require_valid(const Brush& brush);
/// k at a distance in radii, as above but for the texel. Mean over the disc: 0.3, 0.575 and 1 at
/// hardness 0, 0.5 and 1.
double brush_profile(double distance, double hardness);
/// The alpha of one dab.
double dab_alpha(double flow, double spacing);

/// Paints strokes along curves on a surface, while they grow. Dabs are placed by the curve's
/// length, pressure is linear in it, and distances are those along the surface to the curve's
/// pieces, so that neither the frame rate nor the hand's speed shows. What the surface does not
/// join, like the next finger or the other side of a plate, gets no paint. Keeps references to the
/// atlas and, while a stroke is open, to the layers. No allocation after warm-up. Memory:
/// about 90 bytes a vertex.
class StrokePainter {
 public:
  explicit StrokePainter(const PaintAtlas& atlas);
  ~StrokePainter();
  StrokePainter(StrokePainter&&) noexcept;
  StrokePainter& operator=(StrokePainter&&) noexcept;

  /// Opens a stroke. Throws Error(invalid_input) for a brush out of range, layers of another size
  /// than the atlas, and as `PaintLayers::begin_stroke`.
  void begin(PaintLayers& layers, int layer, const Brush& brush);
  /// The same with images, which must stay until `end`. Pressure does nothing to them.
  void begin(PaintLayers& layers, int layer, const Stamp& stamp, const StampImage& image);
  void begin(PaintLayers& layers, int layer, const Ribbon& ribbon, const StampImage& image);
  /// A part of the stroke starts here, with its first dab. Throws Error(invalid_input) for a point
  /// off the mesh, a pressure outside 0 to 1 and where no stroke is open.
  void move_to(const SurfacePoint& point, double pressure = 1.0);
  /// Goes on along a path on the surface. crossings: the edges between the last point and this one,
  /// as all curves have them; a step between two that share no face gets no paint. Throws as
  /// `move_to`; after a stroke was opened with `begin` it is a `move_to`.
  /// O(texels and faces that the brush touches).
  void line_to(std::span<const Crossing> crossings, const SurfacePoint& point,
               double pressure = 1.0);
  /// Puts the stroke on its layer.
  void end();
  /// Forgets it. Both do nothing where no stroke is open.
  void cancel();

  std::size_t memory_bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The whole of a curve in the open stroke: parts between gaps and chords, which get no paint.
/// pressures: one for each point, or empty for 1.
void follow_curve(StrokePainter& painter, const ProjectedCurve& curve,
                  std::span<const double> pressures = {});
/// A curve as one stroke: `begin`, `follow_curve`, `end`. Throws as they do, and then leaves no
/// stroke open.
void paint_curve(StrokePainter& painter, PaintLayers& layers, int layer, const Brush& brush,
                 const ProjectedCurve& curve, std::span<const double> pressures = {});

}  // namespace mimicry
