// node - FOLDER: reads FOLDER/data.json and writes each figure beside it as SVG and PNG.
import { readFile, rename, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { initWasm, Resvg } from '@resvg/resvg-wasm';
import wasm from '@resvg/resvg-wasm/index_bg.wasm';
import { svgOf, view } from './draw.ts';
import type { Data } from './data.ts';
import { figures } from './figures.ts';

/** DejaVu Sans in base64; put before this script by the caller. */
declare const mimicryFont: string;

// Never a half-written file under its name.
async function write(path: string, content: string | Uint8Array): Promise<void> {
  await writeFile(`${path}.part`, content);
  await rename(`${path}.part`, path);
}

async function main(folder: string): Promise<void> {
  await initWasm(wasm);
  const font = Buffer.from(mimicryFont, 'base64');
  const data = JSON.parse(await readFile(join(folder, 'data.json'), 'utf8')) as Data;
  for (const figure of figures(data)) {
    const svg = await svgOf(view(figure));
    await write(join(folder, `${figure.id}.svg`), svg);
    const image = new Resvg(svg, {
      fitTo: { mode: 'zoom', value: 2 },
      font: { fontBuffers: [font], defaultFontFamily: 'DejaVu Sans', sansSerifFamily: 'DejaVu Sans' },
    }).render();
    await write(join(folder, `${figure.id}.png`), image.asPng());
  }
}

main(process.argv[2] ?? '.').catch((error: unknown) => {
  console.error(error instanceof Error ? error.message : String(error));
  process.exitCode = 1;
});
