/** Where the bakes of built-in models lie that were made before the page was built (scripts/embeddings.mjs), by shape. */
const files = import.meta.glob<string>('../../embeddings/*.mimicry', { query: '?url', import: 'default', eager: true });
export const kEmbeddings: ReadonlyMap<string, string> = new Map(
  Object.entries(files).map(([path, url]) => [path.slice(path.lastIndexOf('/') + 1, -'.mimicry'.length), url]),
);
