import type { Stage } from '../scene/stage';
import { clampRadius, kInks } from '../settings';
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
    window.addEventListener('keyup', (event) => {
      if (event.code === 'Space') this.pointer.navigate = false;
    });
    canvas.addEventListener('blur', () => this.lift());
  }

  private down(event: KeyboardEvent): void {
    const at = event.target as HTMLElement;
    if (document.querySelector('dialog[open]') || at.closest('select, input:not([type=range])')) return;
    if (event.ctrlKey || event.metaKey) {
      const key = event.key.toLowerCase();
      if (key === 'z' && event.shiftKey) this.actions.redo();
      else if (key === 'z') this.actions.undo();
      else if (key === 'y') this.actions.redo();
      else if (key === 's') this.actions.saveDrawing();
      else if (key === 'o') this.actions.chooseFiles();
      else return;
      event.preventDefault();
      return;
    }
    if (event.altKey) return;
    const onCanvas = at === this.canvas || at === document.body;
    const onControl = !onCanvas && at.closest('button, input, [popover], a') !== null;
    const { studio } = this;
    const { style } = studio.settings;
    switch (event.key) {
      case 'd': case 'D': studio.set({ tool: 'draw' }); break;
      case 'e': case 'E': studio.set({ tool: 'erase curve' }); break;
      case 'r': case 'R': studio.set({ tool: 'erase part' }); break;
      case 'c': case 'C': toggleCompare(studio); break;
      case 't': case 'T': document.getElementById('techniques')?.togglePopover(); break;
      case 'm': case 'M': studio.set({ mirror: studio.settings.mirror === null ? 'x' : null }); break;
      case 'p': case 'P': studio.set({ penPlace: studio.settings.penPlace === 'in front' ? 'on the surface' : 'in front' }); break;
      case 'f': case 'F': this.actions.frameModel(); break;
      case '[': studio.set({ style: { ...style, radius_m: clampRadius(style.radius_m / 1.15) } }); break;
      case ']': studio.set({ style: { ...style, radius_m: clampRadius(style.radius_m * 1.15) } }); break;
      case '+': case '=': this.stage.rig.zoom(1 / 1.15); break;
      case '-': case '−': this.stage.rig.zoom(1.15); break;
      case '?': this.showHelp(); break;
      case 'Escape':
        if (!this.pen) return;
        this.lift();
        break;
      case ' ':
        if (onControl) return;
        this.pointer.navigate = true;
        break;
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
