// A flight on disk: play, pause, step, seek, rate. Frames are shown by their own times.
import {fetchFrame, fetchJson} from './wire.js';

export class Replay {
  /** `flight`: as /api/flight answers. */
  constructor(name, flight, show, fail) {
    this.name = name;
    this.times = flight.times;
    this.note = flight.note;
    this.show = show;
    this.fail = fail;
    this.frame = -1;
    this.wanted = 0;
    this.rate = 1;
    this.is_playing = false;
    this.is_busy = false;
    this.is_closed = false;
  }

  static async open(name, show, fail, signal) {
    const flight = await fetchJson(`/api/flight?name=${encodeURIComponent(name)}`, signal);
    return new Replay(name, flight, show, fail);
  }

  get last() { return this.times.length - 1; }
  timeOf(frame) { return this.times[frame] / 1e6; }

  seek(frame) {
    this.wanted = Math.max(0, Math.min(this.last, frame));
    this.anchor();
    this.pump();
  }
  step(frames) {
    this.pause();
    this.seek(this.wanted + frames);
  }
  stepSeconds(seconds) { this.seek(this.frameAt(this.timeOf(this.wanted) + seconds)); }
  setRate(rate) {
    this.rate = rate;
    this.anchor();
  }
  play() {
    if (this.wanted === this.last) this.wanted = 0;
    this.is_playing = true;
    this.anchor();
    this.tick();
  }
  pause() { this.is_playing = false; }
  close() {
    this.is_closed = true;
    this.pause();
  }

  /** The last frame at or before this time [s]. */
  frameAt(seconds) {
    let low = 0;
    let high = this.last;
    while (low < high) {
      const middle = Math.ceil((low + high) / 2);
      if (this.timeOf(middle) <= seconds) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  anchor() {
    this.anchor_wall = performance.now();
    this.anchor_time = this.timeOf(this.wanted);
  }

  tick() {
    if (!this.is_playing) return;
    const elapsed = (performance.now() - this.anchor_wall) / 1000;
    this.wanted = this.frameAt(this.anchor_time + elapsed * this.rate + 1e-6);
    if (this.wanted === this.last) this.pause();
    this.pump();
    if (this.is_playing) requestAnimationFrame(() => this.tick());
  }

  async pump() {
    if (this.is_busy || this.is_closed || this.wanted === this.frame) return;
    this.is_busy = true;
    const k = this.wanted;
    try {
      const frame = await fetchFrame(`/api/flight/frame?name=${encodeURIComponent(this.name)}&k=${k}`);
      this.frame = k;
      if (!this.is_closed) this.show(frame, k);
    } catch (error) {
      this.frame = k;
      if (!this.is_closed) this.fail(error.message);
    }
    this.is_busy = false;
    this.pump();
  }
}
