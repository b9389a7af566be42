import { sentence } from '../base/text';
import type { Listed } from '../drawing/library';
import type { Documents } from '../studio/documents';
import { h, icon, kIcons } from './dom';
import type { Messages } from './messages';

/** The drawings of this browser: open, rename, delete, and a new one. */
export function drawingsPanel(documents: Documents, messages: Messages): HTMLElement {
  const rows = h('ul', { class: 'drawings', 'aria-label': 'Drawings' });
  const foot = h('p', { class: 'remarks' });
  const close = (): void => panel.hidePopover();
  const fresh = h('button', { class: 'list-button', type: 'button', onclick: () => { close(); documents.fresh(); } }, icon(kIcons.plus), 'New drawing', h('small', {}, 'on this model'));
  const panel = h('div', { id: 'drawings', popover: 'auto', role: 'dialog', 'aria-label': 'Drawings', ontoggle: () => void show() }, h('p', { class: 'sheet-title' }, 'Drawings'), fresh, h('hr', { class: 'hairline' }), rows, foot);

  const attempt = (act: () => Promise<unknown>): void => {
    act().catch((error: unknown) => {
      if (!(error instanceof DOMException && error.name === 'AbortError')) messages.problem(sentence(error));
    });
  };

  const remove = async (drawing: Listed): Promise<void> => {
    const back = await documents.remove(drawing.id);
    messages.note(`“${drawing.name}” is deleted.`, { title: 'Undo', act: () => attempt(back) });
    messages.say(`${drawing.name} is deleted; Undo brings it back.`);
  };

  const rename = (row: HTMLElement, drawing: Listed): void => {
    const field = h('input', { type: 'text', value: drawing.name, maxlength: 80, 'aria-label': `New name of ${drawing.name}` });
    let isDone = false;
    const end = (keep: boolean): void => {
      if (isDone) return;
      isDone = true;
      const name = field.value.trim();
      if (keep && name && name !== drawing.name) attempt(() => documents.rename(drawing.id, name).then(() => messages.say(`The drawing is called ${name}.`)));
      void show();
    };
    field.addEventListener('keydown', (event) => {
      event.stopPropagation();
      if (event.key === 'Enter') end(true);
      if (event.key !== 'Escape') return;
      event.preventDefault(); // closes the field and not the panel
      end(false);
    });
    field.addEventListener('blur', () => end(true));
    row.replaceChildren(field);
    field.select();
  };

  const rowOf = (drawing: Listed): HTMLElement => {
    const { id, name, strokes, changed_ms, model } = drawing;
    const what = `${strokes === 0 ? 'empty' : `${strokes} stroke${strokes === 1 ? '' : 's'}`}, ${when(changed_ms)}`;
    const row = h('li', {});
    if (drawing.deleted_ms !== null) {
      row.append(h('span', { class: 'deleted' }, name), h('button', { class: 'button', type: 'button', onclick: () => attempt(() => documents.library.bringBack(id)) }, 'Bring back'));
      return row;
    }
    const isOpen = documents.open.now?.id === id;
    row.append(
      h('button', { class: 'list-button', type: 'button', 'aria-current': String(isOpen), title: `${name}: ${model}, ${what}`, onclick: () => { close(); attempt(() => documents.openKept(id).then(() => messages.say(`${name} is open.`))); } },
        h('span', {}, name), h('small', {}, what)),
      h('button', { class: 'button', type: 'button', title: 'Rename', 'aria-label': `Rename ${name}`, onclick: () => rename(row, drawing) }, icon(kIcons.rename)),
      h('button', { class: 'button', type: 'button', title: 'Delete', 'aria-label': `Delete ${name}`, onclick: () => attempt(() => remove(drawing)) }, icon(kIcons.trash)));
    return row;
  };

  const show = async (): Promise<void> => {
    if (!panel.matches(':popover-open')) return;
    try {
      const list = await documents.list();
      rows.replaceChildren(...[...list.filter((d) => d.deleted_ms === null), ...list.filter((d) => d.deleted_ms !== null)].map(rowOf));
      const persisted = await navigator.storage?.persisted?.();
      foot.textContent = `${persisted ? 'Kept in this browser.' : 'Kept in this browser, which may clear them when space runs short: save to files what matters.'} Deleted drawings can be brought back for a week.`;
    } catch {
      rows.replaceChildren();
      foot.textContent = 'The browser does not let this page keep drawings. Save them to files.';
    }
  };
  documents.listed.watch(() => void show());
  return panel;
}

/** A time for people: today by the clock, else by the day. */
function when(time_ms: number): string {
  const time = new Date(time_ms);
  return time.toDateString() === new Date().toDateString()
    ? time.toLocaleTimeString([], { hour: '2-digit', minute: '2-digit' })
    : time.toLocaleDateString([], { day: 'numeric', month: 'short' });
}
