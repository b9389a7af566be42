/** How long another tab may take to go (a reload of this one) or to answer. */
const kPatience_ms = 250;
const kChannel = 'mimicry-drawings';

type Word = { saved: readonly string[] } | { listed: true } | { ask: string } | { held: string } | { left: string };

/** What the tabs of this browser tell each other. */
export class Tabs {
  private readonly channel = 'BroadcastChannel' in globalThis ? new BroadcastChannel(kChannel) : null;
  private readonly listeners = new Set<(word: Word) => void>();

  constructor() {
    this.channel?.addEventListener('message', ({ data }: MessageEvent<Word>) => {
      for (const listener of [...this.listeners]) listener(data);
    });
  }

  tell(word: Word): void {
    this.channel?.postMessage(word);
  }

  listen(listener: (word: Word) => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }
}

/** A tab's claim on a drawing. */
export interface Claim {
  /** This tab writes. */
  isMine: boolean;
  release(): void;
}

/**
 * One tab writes a drawing: the one that holds its Web Lock. Where there are no locks (plain HTTP) tabs
 * ask each other.
 */
export class Claims {
  private readonly mine = new Set<string>();

  constructor(private readonly tabs: Tabs, private readonly locks = globalThis.navigator?.locks as LockManager | undefined) {
    if (locks) return;
    tabs.listen((word) => {
      if ('ask' in word && this.mine.has(word.ask)) tabs.tell({ held: word.ask });
    });
    addEventListener('pagehide', () => {
      for (const id of this.mine) tabs.tell({ left: id });
    });
  }

  /** Claims a drawing. Where another tab has it, `freed` is called once it is this one's turn. */
  async claim(id: string, freed: () => void): Promise<Claim> {
    return this.locks ? this.lock(this.locks, id, freed) : this.ask(id, freed);
  }

  /** Whether a tab, this one too, writes the drawing. */
  async isHeld(id: string): Promise<boolean> {
    if (this.mine.has(id)) return true;
    if (!this.locks) return !(await this.nobody(id));
    return ((await this.locks.query()).held ?? []).some((lock) => lock.name === lockName(id));
  }

  private lock(locks: LockManager, id: string, freed: () => void): Promise<Claim> {
    const waiting = new AbortController();
    let end = (): void => waiting.abort();
    return new Promise<Claim>((resolve) => {
      const claim: Claim = { isMine: false, release: () => end() };
      const patience = setTimeout(() => resolve(claim), kPatience_ms);
      locks.request(lockName(id), { signal: waiting.signal }, () => new Promise<void>((over) => {
        this.mine.add(id);
        clearTimeout(patience);
        claim.isMine = true;
        end = () => {
          this.mine.delete(id);
          over();
        };
        resolve(claim);
        freed();
      })).catch(() => undefined); // no longer wanted
    });
  }

  private async ask(id: string, freed: () => void): Promise<Claim> {
    const claim: Claim = { isMine: false, release: () => undefined };
    const own = (): void => {
      this.mine.add(id);
      claim.isMine = true;
      claim.release = () => {
        this.mine.delete(id);
        this.tabs.tell({ left: id });
      };
    };
    if (await this.nobody(id)) {
      own();
    } else {
      claim.release = this.tabs.listen((word) => {
        if (!('left' in word) || word.left !== id) return;
        claim.release();
        own();
        freed();
      });
    }
    return claim;
  }

  private nobody(id: string): Promise<boolean> {
    return new Promise((resolve) => {
      const stop = this.tabs.listen((word) => {
        if (!('held' in word) || word.held !== id) return;
        stop();
        resolve(false);
      });
      this.tabs.tell({ ask: id });
      setTimeout(() => {
        stop();
        resolve(true);
      }, kPatience_ms);
    });
  }
}

function lockName(id: string): string {
  return `mimicry-drawing/${id}`;
}
