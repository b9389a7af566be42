import type { PenSample, Tool } from '../tools/tool';

/** How a mouse, a pen or a finger uses a tool, from press to release. */
export interface ScreenUse {
  /** Starts where the model is under the pointer; false where it is not, or the tool does not want to. */
  press(event: PointerEvent, tool: Tool, end: PenSample['end']): boolean;
  move(event: PointerEvent): void;
  /** False where the wheel is not the tool's. steps: positive toward the eye. */
  wheel(steps: number): boolean;
  release(): void;
  cancel(): void;
}
