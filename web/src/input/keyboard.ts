import type { Stage } from '../scene/stage';
import { kInks, resized } from '../settings';
import type { Studio } from '../studio';
import type { Actions } from '../ui/actions';
import { toggleCompare } from '../ui/interface';
import type { PointerInput } from './pointer_input';

const kTurn_rad = 0.12;
const kPenStep_px = 6;
const kPenId = 9901;

/** Keys, and drawing without a pointer: Enter puts the pen down, the arrows move it, Enter lifts it. */
export class Keyboard {
  private pen: { x: number; y: number } | null = null;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly stage: Stage, private readonly studio: Studio, private readonly pointer: PointerInput, private readonly actions: Actions, private readonly showHelp: () => void) {
    window.addEventListener('keydown', (event) => this.down(event));
    window.addEventListener('keyup', (event) => this.up(event), true);
    canvas.addEventListener('blur', () => this.lift());
  }

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
    const { studio } = this;
    const { style, penPlace } = studio.settings;
    switch (event.key) {
      case 'd': case 'D': studio.set({ tool: 'draw' }); break;
      case 'e': case 'E': studio.set({ tool: 'erase curve' }); break;
      case 'r': case 'R': studio.set({ tool: 'erase part' }); break;
      case 'c': case 'C': toggleCompare(studio); break;
      case 't': case 'T': document.getElementById('techniques')?.togglePopover(); break;
      case 'm': case 'M': studio.set({ mirror: studio.settings.mirror === null ? 'x' : null }); break;
      case 'p': case 'P': studio.set({ penPlace: penPlace === 'on a plane' ? 'under the pointer' : 'on a plane' }); break;
      case 'u': case 'U': this.lift(); this.actions.turnModel(event.shiftKey ? 'z' : 'x'); break;
      case 'f': case 'F': this.actions.frameModel(); break;
      case '[': studio.set(resized(studio.settings, 1 / 1.15)); break;
      case ']': studio.set(resized(studio.settings, 1.15)); break;
      case '+': case '=': this.stage.rig.zoom(1 / 1.15); break;
      case '-': case '−': this.stage.rig.zoom(1.15); break;
      case '?': this.showHelp(); break;
      case 'Enter':
        if (onControl) return;
        if (this.pen) this.lift();
        else this.put();
        break;
      case 'ArrowLeft': case 'ArrowRight': case 'ArrowUp': case 'ArrowDown':
        if (onControl) return;
        this.arrow(event.key, event.shiftKey);
        break;
      default: {
        const ink = kInks[Number(event.key) - 1];
        if (!ink) return;
        studio.set({ style: { ...style, color: ink.color }, tool: 'draw' });
      }
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
    if (!this.studio.isDrawing && this.studio.settings.tool === 'draw') {
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
