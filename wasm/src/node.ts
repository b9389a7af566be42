export const isNode = typeof process !== 'undefined' && process.versions?.node !== undefined;

/** A module of Node's own. Its name is an argument, so that no bundler follows it. */
export async function builtin<T>(name: string): Promise<T> {
  const direct = process as { getBuiltinModule?: (name: string) => unknown }; // Node 20.16 and later
  return (direct.getBuiltinModule?.(name) ?? (await import(/* webpackIgnore: true */ /* @vite-ignore */ name))) as T;
}
