#!/usr/bin/env bash
# docs/pictures.sh [MIMICRY]: makes the pictures of docs/techniques/ with the program `mimicry`.
# Seeded strokes on built-in shapes: the same pictures every time.
set -euo pipefail
cd "$(dirname "$0")/.."
mimicry=$(realpath "${1:-build/release/bin/mimicry}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p docs/techniques/pictures

# picture NAME TECHNIQUE SHAPE CURVE [ZOOM]
picture() {
  local name=$1 technique=$2 shape=$3 curve=$4 zoom=${5:-1.1}
  local strokes="$work/${shape/:/-}-$curve.json" out="$work/out"
  [ -f "$strokes" ] || "$mimicry" simulate "shape:$shape" --curves "$curve" -o "$strokes" > /dev/null
  "$mimicry" project "shape:$shape" "$strokes" -t "$technique" -o "$out" --formats json > /dev/null
  "$mimicry" render "shape:$shape" --strokes "$strokes" --curves "$out/curves.json" --intended \
    --zoom "$zoom" --width 420 --height 340 -o "docs/techniques/pictures/$name.png" > /dev/null
}

picture occlude-shines occlude plate winding
picture occlude-fails occlude cube winding
picture spraycan-shines spraycan cube winding
picture spraycan-fails spraycan hand winding
picture head-centric-shines head-centric plate winding
picture head-centric-fails head-centric torus winding
picture snap-shines snap plate winding
picture snap-fails snap cube winding
picture snap-smooth-shines snap-smooth plate winding
picture snap-smooth-fails snap-smooth torus closed
picture anchored-closest-shines anchored-closest torus closed
picture anchored-closest-fails anchored-closest noisy-cube winding 1.2
picture mimicry-shines mimicry cube winding
picture mimicry-fails mimicry trefoil winding
picture mimicry-planar-shines mimicry-planar plate winding
picture mimicry-planar-fails mimicry-planar torus closed
picture mimicry-offset-shines mimicry-offset cube across
picture mimicry-offset-fails mimicry-offset trefoil winding
picture mimicry-parallel-shines mimicry-parallel torus closed
picture mimicry-parallel-fails mimicry-parallel torus winding
picture anchored-ray-plane-shines anchored-ray-plane cube winding
picture anchored-ray-plane-fails anchored-ray-plane torus winding
picture anchored-ray-transport-shines anchored-ray-transport torus closed
picture anchored-ray-transport-fails anchored-ray-transport hand winding
picture mimicry-live-shines mimicry-live hand winding
picture mimicry-live-fails mimicry-live torus winding
