/** Built-in models whose bake comes with the page. */
declare const __EMBEDDINGS__: readonly string[];
