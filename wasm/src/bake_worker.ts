// The whole worker, a script without imports when it is packed: it starts as a file, from its text, and in Node.
import { runBake, type BakeNews, type BakeOrder } from './bake_run.js';
import { messageOf, MimicryError } from './error.js';
import { builtin, isNode } from './node.js';

// No more news than a progress bar can show.
const kLeastPause_ms = 50;

type Tell = (news: BakeNews, transfer: ArrayBuffer[]) => void;

async function obey({ code, mesh, settings }: BakeOrder, tell: Tell): Promise<void> {
  let last = -Infinity;
  try {
    const bytes = await runBake(code, mesh, settings, (stage, fraction) => {
      const now = performance.now();
      if (now - last < kLeastPause_ms) return;
      last = now;
      tell({ stage, fraction }, []);
    });
    tell({ bytes }, [bytes.buffer as ArrayBuffer]);
  } catch (error) {
    tell({ status: error instanceof MimicryError ? error.status : 'failed', message: messageOf(error) }, []);
  }
}

if (isNode)
  void builtin<typeof import('node:worker_threads')>('node:worker_threads').then(({ parentPort }) =>
    parentPort?.on('message', (order: BakeOrder) => void obey(order, (news, transfer) => parentPort.postMessage(news, transfer))));
else {
  const page = self as unknown as Worker;
  page.onmessage = ({ data }: MessageEvent<BakeOrder>) => void obey(data, (news, transfer) => page.postMessage(news, transfer));
}
