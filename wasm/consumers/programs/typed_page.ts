import { Mimicry, type WasmSource } from 'mimicry';
import { bake } from 'mimicry/bake';

// What a page has is what the package takes and gives.
export async function page(mimicry: Mimicry): Promise<Blob> {
  const places: WasmSource[] = ['core.wasm', new URL('core.wasm', location.href), fetch('core.wasm'), await fetch('core.wasm'), await WebAssembly.compile(new ArrayBuffer(8))];
  await new Mimicry({ wasm: places[0]! }).ready;
  const mesh = mimicry.shape('hand');
  const stop = new AbortController();
  const bytes = await bake(mesh, { signal: stop.signal, worker: new Worker('worker.js') });
  postMessage(mesh, '*', [mesh.positions.buffer, mesh.faces.buffer]);
  return new Blob([bytes, mesh.positions]);
}
