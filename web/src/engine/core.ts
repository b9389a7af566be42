/** The core as the studio uses it. */
export { kInked, kInkFrame, kInkNormal, kInkPosition, kInkStarts, kInkStride, kMissed, Mimicry, type Curve, type CurveFormat, type Ink, type MeshArrays, type MeshReport, type RecordedStroke, type Session, type SurfaceHit, type Target, type TargetImage, type TechniqueInfo } from 'mimicry';
export type { Mimicry as Core } from 'mimicry';
