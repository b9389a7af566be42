import factory from './bake_module.js';
import { kBakeBuild } from './builds.js';
import { givenCount } from './given.js';
import type { WasmFile } from './load.js';
import { withMesh, type MeshInput } from './mesh.js';
import { calling, instantiate, made, takeBytes } from './module.js';
import type { Bytes } from './types.js';

export const kBakeFile: WasmFile = { name: 'bake.wasm', build: kBakeBuild };

export interface BakeSettings {
  /** Of the embedding, 3 to 8. */
  dimension?: number;
  /** At most. */
  samples?: number;
  /** Half the shell's thickness, part of the diagonal. */
  offset?: number;
}

/** Blocks its thread until the bake is done. code: a `WebAssembly.Module`. */
export async function runBake(code: object, mesh: MeshInput, settings: BakeSettings, onProgress?: (stage: string, fraction: number) => void): Promise<Bytes> {
  const m = await instantiate(factory, code, {
    onBakeProgress(stage, fraction) {
      onProgress?.(stage, fraction);
      return 1;
    },
  });
  return withMesh(m, mesh, '', (pointer) =>
    calling(m, (args) => {
      const chosen = args.room(32);
      m._mimicry_wasm_default_bake_options(chosen);
      if (settings.dimension !== undefined) m.HEAP32[chosen >> 2] = givenCount(settings.dimension, 'option dimension');
      if (settings.samples !== undefined) m.HEAP32[(chosen >> 2) + 1] = givenCount(settings.samples, 'option samples');
      if (settings.offset !== undefined) m.HEAPF64[(chosen >> 3) + 1] = settings.offset;
      return takeBytes(m, made(m, (_, out) => m._mimicry_wasm_bake(pointer, chosen, out)));
    }));
}

/** What goes to the worker, and what comes back. */
export interface BakeOrder { code: object; mesh: MeshInput; settings: BakeSettings }
export type BakeNews = { stage: string; fraction: number } | { bytes: Bytes } | { status: string; message: string };
