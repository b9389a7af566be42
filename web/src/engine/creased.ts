import { equalPlaces } from './places';

/** What is shown of a mesh: its vertices, once for each normal that one has. */
export interface Corners {
  positions: Float32Array; // 3 a corner
  normals: Float32Array; // 3 a corner
  faces: Uint32Array; // 3 corners a face
}

/**
 * Corner normals that are smooth within a surface and broken at its sharp edges: the mean, weighted
 * by angle, of the faces around the vertex (and those at its position) that lie within `crease_rad` of the corner's own face.
 * O(faces around the vertices, squared).
 */
export function creasedCorners(positions: Float64Array, faces: Int32Array, crease_rad: number): Corners {
  const count = faces.length / 3;
  const normals = new Float32Array(faces.length); // unit, a face
  const angles = new Float32Array(faces.length); // at each corner
  const edge = new Float64Array(9);
  for (let f = 0; f < count; f += 1) {
    for (let k = 0; k < 3; k += 1) {
      const a = 3 * faces[3 * f + k]!, b = 3 * faces[3 * f + ((k + 1) % 3)]!;
      let n = 0;
      for (let d = 0; d < 3; d += 1) {
        edge[3 * k + d] = positions[b + d]! - positions[a + d]!;
        n += edge[3 * k + d]! ** 2;
      }
      n = Math.sqrt(n) || 1;
      for (let d = 0; d < 3; d += 1) edge[3 * k + d]! /= n;
    }
    for (let k = 0; k < 3; k += 1) {
      const p = 3 * ((k + 2) % 3), q = 3 * k;
      const cosine = -(edge[p]! * edge[q]! + edge[p + 1]! * edge[q + 1]! + edge[p + 2]! * edge[q + 2]!);
      angles[3 * f + k] = Math.acos(Math.min(1, Math.max(-1, cosine)));
    }
    const x = edge[1]! * edge[5]! - edge[2]! * edge[4]!, y = edge[2]! * edge[3]! - edge[0]! * edge[5]!, z = edge[0]! * edge[4]! - edge[1]! * edge[3]!;
    const n = Math.hypot(x, y, z) || 1;
    normals[3 * f] = x / n; normals[3 * f + 1] = y / n; normals[3 * f + 2] = z / n;
  }

  // Corners by place.
  const place = equalPlaces(positions);
  const first = new Uint32Array(positions.length / 3 + 1);
  for (const v of faces) first[place[v]! + 1]! += 1;
  for (let v = 1; v < first.length; v += 1) first[v]! += first[v - 1]!;
  const next = first.slice();
  const corners = new Uint32Array(faces.length);
  for (let c = 0; c < faces.length; c += 1) {
    const v = place[faces[c]!]!;
    corners[next[v]!] = c;
    next[v]! += 1;
  }

  const threshold = Math.cos(crease_rad);
  const out = { positions: new Float32Array(3 * faces.length), normals: new Float32Array(3 * faces.length), faces: new Uint32Array(faces.length) };
  const latest = new Int32Array(positions.length / 3).fill(-1), earlier = new Int32Array(faces.length); // a vertex's corners
  const normal = new Float32Array(3);
  let made = 0;
  for (let c = 0; c < faces.length; c += 1) {
    const v = place[faces[c]!]!, own = 3 * Math.floor(c / 3);
    let x = 0, y = 0, z = 0;
    for (let i = first[v]!; i < first[v + 1]!; i += 1) {
      const other = 3 * Math.floor(corners[i]! / 3);
      const cosine = normals[own]! * normals[other]! + normals[own + 1]! * normals[other + 1]! + normals[own + 2]! * normals[other + 2]!;
      if (cosine < threshold) continue;
      const w = angles[corners[i]!]!;
      x += w * normals[other]!; y += w * normals[other + 1]!; z += w * normals[other + 2]!;
    }
    let n = Math.hypot(x, y, z);
    if (!(n > 0)) { x = normals[own]!; y = normals[own + 1]!; z = normals[own + 2]!; n = 1; }
    normal[0] = x / n; normal[1] = y / n; normal[2] = z / n;
    // Corners that see the same faces sum the same numbers in the same order.
    let corner = latest[v]!;
    while (corner >= 0 && (out.normals[3 * corner] !== normal[0] || out.normals[3 * corner + 1] !== normal[1] || out.normals[3 * corner + 2] !== normal[2])) corner = earlier[corner]!;
    if (corner < 0) {
      corner = made;
      made += 1;
      earlier[corner] = latest[v]!;
      latest[v] = corner;
      for (let d = 0; d < 3; d += 1) out.positions[3 * corner + d] = positions[3 * v + d]!;
      out.normals.set(normal, 3 * corner);
    }
    out.faces[c] = corner;
  }
  return { positions: out.positions.slice(0, 3 * made), normals: out.normals.slice(0, 3 * made), faces: out.faces };
}
