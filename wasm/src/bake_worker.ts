import { bakeHere, MimicryError, type BakeNews, type BakeOrder } from './bake.js';

// No more news than a progress bar can show.
const kLeastPause_ms = 50;

const tell = (news: BakeNews, transfer: Transferable[] = []) => (self as unknown as Worker).postMessage(news, transfer);

self.onmessage = async ({ data }: MessageEvent<BakeOrder>) => {
  let last = -Infinity;
  const onProgress = (stage: string, fraction: number) => {
    const now = performance.now();
    if (now - last < kLeastPause_ms) return;
    last = now;
    tell({ stage, fraction });
  };
  try {
    const { mesh, ...options } = data;
    const bytes = await bakeHere(mesh, { ...options, onProgress });
    tell({ bytes }, [bytes.buffer]);
  } catch (error) {
    tell({ status: error instanceof MimicryError ? error.status : 'failed', message: String(error instanceof Error ? error.message : error) });
  }
};
