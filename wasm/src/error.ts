export type Status =
  | 'invalid_input' | 'io' | 'unsupported' | 'cancelled' | 'out_of_memory' | 'failed' | 'disposed';

/** The message is a sentence that names the thing, the place and the remedy. */
export class MimicryError extends Error {
  override readonly name = 'MimicryError';
  constructor(readonly status: Status, message: string, options?: { cause?: unknown }) {
    super(message, options);
  }
}

/** The sentence of whatever was thrown. */
export const messageOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));
