import { kInks } from '../drawing/ink_styles';
import type { Stage } from '../scene/stage';
import type { Actions } from '../studio/actions';
import type { Studio } from '../studio/studio';
import type { Tools } from '../tools/tools';
import type { PointerInput } from './pointer_input';

const kTurn_rad = 0.12;
const kPenStep_px = 6;
const kPenId = 9901;

type Act = (event: KeyboardEvent, onControl: boolean) => false | void;

/** Keys, and drawing without a pointer: Enter puts the pen down, the arrows move it, Enter lifts it. */
export class Keyboard {
  private pen: { x: number; y: number } | null = null;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly stage: Stage, private readonly studio: Studio, private readonly tools: Tools, private readonly pointer: PointerInput, private readonly actions: Actions, private readonly showHelp: () => void) {
    tools.list.watch((list) => {
      const taken = list.find(({ key }) => this.keys.has(key));
      if (taken) throw new Error(`The key ${taken.key} is the page's; give the tool “${taken.name}” another one.`);
    });
    window.addEventListener('keydown', (event) => this.down(event));
    window.addEventListener('keyup', (event) => this.up(event), true);
    canvas.addEventListener('blur', () => this.lift());
  }

  /** What the page's own keys do; tools have theirs. False: the key is the control's that has the focus. */
  private readonly keys: ReadonlyMap<string, Act> = new Map<string, Act>([
    ['c', () => this.studio.toggleCompare()],
    ['t', () => { document.getElementById('techniques')?.togglePopover(); }],
    ['m', () => this.studio.set({ mirror: this.studio.settings.mirror === null ? 'x' : null })],
    ['p', () => this.studio.set({ penPlace: this.studio.settings.penPlace === 'on a plane' ? 'under the pointer' : 'on a plane' })],
    ['u', ({ shiftKey }) => { this.lift(); this.actions.turnModel(shiftKey ? 'z' : 'x'); }],
    ['f', () => this.actions.frameModel()],
    ['[', () => this.tools.resize(1 / 1.15)],
    [']', () => this.tools.resize(1.15)],
    ['+', () => this.stage.rig.zoom(1 / 1.15)],
    ['=', () => this.stage.rig.zoom(1 / 1.15)],
    ['-', () => this.stage.rig.zoom(1.15)],
    ['−', () => this.stage.rig.zoom(1.15)],
    ['?', () => this.showHelp()],
    ['Enter', (_, onControl) => (onControl ? false : this.pen ? this.lift() : this.put())],
    ...['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown'].map((arrow) =>
      [arrow, ({ shiftKey }, onControl) => (onControl ? false : this.arrow(arrow, shiftKey))] satisfies [string, Act]),
  ]);

  private down(event: KeyboardEvent): void {
    const at = event.target instanceof HTMLElement ? event.target : document.body;
    if (writesText(at)) return;
    if (event.ctrlKey || event.metaKey) {
      const key = latin(event);
      this.lift();
      if (key === 'z' && event.shiftKey) this.actions.redo();
      else if (key === 'z') this.actions.undo();
      else if (key === 'y') this.actions.redo();
      else if (key === 's') this.actions.saveDrawing();
      else if (key === 'o') this.actions.chooseFiles();
      else return;
      event.preventDefault();
      return;
    }
    if (event.key === 'Escape' && (this.pointer.cancel() || this.pen)) {
      this.pen = null;
      event.preventDefault();
      return;
    }
    if (event.altKey || document.querySelector('dialog[open]')) return;
    if (event.code === 'Space') this.space(event, at);
    if (at.closest('select')) return;
    const onCanvas = at === this.canvas || at === document.body;
    const onControl = !onCanvas && at.closest('button, input, [popover], a') !== null;
    const key = event.key.length === 1 ? latin(event) : event.key;
    const act = this.keys.get(key), ink = kInks[Number(key) - 1];
    if (act) {
      if (act(event, onControl) === false) return;
    } else if (ink) {
      this.tools.ink(ink.color);
    } else if (!this.tools.chooseByKey(key)) {
      return;
    }
    event.preventDefault();
    this.stage.invalidate();
  }

  /** Held: the pointer navigates. Where a control has the focus it is the control's too, unless it is used to navigate. */
  private space(event: KeyboardEvent, at: HTMLElement): void {
    this.pointer.navigate = true;
    if (!event.repeat) this.pointer.navigated = false;
    const control = at.closest('button, input, [popover], a, select');
    if (!control || this.pointer.navigated || (this.pointer.over && control.matches('select'))) event.preventDefault();
  }

  private up(event: KeyboardEvent): void {
    if (event.code !== 'Space' && event.key !== 'Alt') return;
    if (event.code === 'Space') this.pointer.navigate = false;
    if (this.pointer.navigated) event.preventDefault(); // no click of a button that has the focus, no menu of the browser
    this.pointer.navigated = false;
  }

  private arrow(key: string, fast: boolean): void {
    const x = key === 'ArrowLeft' ? -1 : key === 'ArrowRight' ? 1 : 0;
    const y = key === 'ArrowUp' ? -1 : key === 'ArrowDown' ? 1 : 0;
    if (this.pen) {
      const step = fast ? 4 * kPenStep_px : kPenStep_px;
      this.pen.x += x * step;
      this.pen.y += y * step;
      this.send('pointermove');
    } else {
      this.stage.rig.orbit(x * kTurn_rad, -y * kTurn_rad);
    }
  }

  private put(): void {
    const rect = this.canvas.getBoundingClientRect();
    this.pen = { x: rect.left + (this.stage.split ? rect.width / 4 : rect.width / 2), y: rect.top + rect.height / 2 };
    this.send('pointerdown');
    if (!this.pointer.isUsing) {
      this.lift();
      this.actions.say('The model is not in the middle of the window. Arrow keys turn it, F shows all of it.');
    }
  }

  private lift(): void {
    if (!this.pen) return;
    this.send('pointerup');
    this.pen = null;
  }

  private send(type: string): void {
    this.canvas.dispatchEvent(new PointerEvent(type, {
      pointerId: kPenId, pointerType: 'mouse', button: type === 'pointermove' ? -1 : 0, buttons: type === 'pointerup' ? 0 : 1,
      clientX: this.pen!.x, clientY: this.pen!.y, bubbles: true,
    }));
  }
}

/** Where keys are text, and undo is the text's. */
function writesText(at: HTMLElement): boolean {
  return at.isContentEditable || at.closest('textarea, input:not([type=range], [type=radio], [type=checkbox], [type=button], [type=color], [type=file])') !== null;
}

/** The letter of a key, on keyboards of other scripts the one that stands there on a Latin one. */
function latin(event: KeyboardEvent): string {
  if (/^[a-z]$/i.test(event.key) || !event.code.startsWith('Key')) return event.key.toLowerCase();
  return event.code.slice(3).toLowerCase();
}
