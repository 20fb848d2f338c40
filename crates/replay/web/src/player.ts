// Which step is shown, and how it goes on.

export const SPEEDS = [1, 2, 5, 10, 20, 40];

export class Player {
  index = 0;
  playing = false;
  speed = 5;
  readonly #listeners: (() => void)[] = [];
  #due = 0;

  constructor(readonly count: number) {}

  /** Calls `listener` after every change. */
  onChange(listener: () => void): void {
    this.#listeners.push(listener);
  }

  seek(index: number): void {
    const there = Math.min(Math.max(Math.round(index), 0), this.count - 1);
    if (Number.isNaN(there) || there === this.index) return;
    this.index = there;
    this.#changed();
  }

  step(by: number): void {
    this.pause();
    this.seek(this.index + by);
  }

  /** Starts, from the beginning when at the end; or stops. */
  toggle(): void {
    this.playing = !this.playing && this.count > 1;
    if (this.playing) {
      if (this.index === this.count - 1) this.index = 0;
      this.#due = performance.now() + 1000 / this.speed;
      requestAnimationFrame(this.#tick);
    }
    this.#changed();
  }

  pause(): void {
    if (this.playing) this.toggle();
  }

  setSpeed(speed: number): void {
    this.speed = Math.min(Math.max(speed, SPEEDS[0]), SPEEDS[SPEEDS.length - 1]);
    this.#changed();
  }

  /** The next faster (1) or slower (−1) speed. */
  shiftSpeed(by: number): void {
    const at = SPEEDS.findIndex((speed) => speed >= this.speed);
    this.setSpeed(SPEEDS[Math.min(Math.max(at + by, 0), SPEEDS.length - 1)]);
  }

  /** A frame that comes late shows the step that is due then, and skips those before. */
  readonly #tick = (now: number): void => {
    if (!this.playing) return;
    const period = 1000 / this.speed;
    if (now >= this.#due) {
      const steps = 1 + Math.floor((now - this.#due) / period);
      this.#due += steps * period;
      this.index = Math.min(this.index + steps, this.count - 1);
      if (this.index === this.count - 1) this.playing = false;
      this.#changed();
    }
    if (this.playing) requestAnimationFrame(this.#tick);
  };

  #changed(): void {
    for (const listener of this.#listeners) listener();
  }
}
