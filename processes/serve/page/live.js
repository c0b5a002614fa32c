// The newest frame, whenever there is one: asked for when the one before is drawn, so that none waits for this page.
import {fetchFrame} from './wire.js';

/** `show(frame)` and `fail(words)` are called while `is_on` is true. */
export class Live {
  constructor(show, fail) {
    this.show = show;
    this.fail = fail;
    this.is_on = true;
    this.newest = 0;
    this.shown = 0;
    this.is_busy = false;
    this.last_time = performance.now();
  }

  onFrame(sequence) {
    this.newest = sequence;
    this.pump();
  }

  async pump() {
    if (!this.is_on || this.is_busy || this.newest === this.shown) return;
    this.is_busy = true;
    try {
      const frame = await fetchFrame(`/api/frame?after=${this.shown}`);
      if (frame) {
        this.shown = frame.sequence;
        this.last_time = performance.now();
        if (this.is_on) this.show(frame);
      } else {
        this.newest = this.shown;
      }
    } catch (error) {
      this.newest = this.shown;
      if (this.is_on) this.fail(error.message);
    }
    this.is_busy = false;
    if (this.newest > this.shown) requestAnimationFrame(() => this.pump());
  }

  /** Seconds since the last frame. */
  silence() { return (performance.now() - this.last_time) / 1000; }
}
