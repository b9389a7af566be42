import type { Documents } from '../studio/documents';
import type { Messages } from './messages';

/** Says when another tab draws on the open drawing, and names the drawing in the window's title. */
export function followTabs(documents: Documents, messages: Messages): void {
  let close: (() => void) | null = null;
  documents.open.watch((now) => {
    document.title = now ? `${now.name} · mimicry studio` : 'mimicry studio';
    if (now && !now.writes) {
      close ??= messages.standing('This drawing is open in another tab; this one shows what is drawn there. If you draw here, you draw on a copy.', { title: 'Draw on a copy', act: () => documents.copy() });
    } else if (now) {
      close?.();
      close = null;
    }
  });
}
