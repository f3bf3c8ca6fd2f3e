// Calls a function in each frame with the elapsed seconds while playing.

/** A frame clock. A late frame, for example after a switch of tabs, counts as a twentieth of a second. */
export class Player {
  constructor(advance) {
    this.advance = advance;
    this.request = 0;
    this.before = 0;
    this.frame = (time) => {
      this.request = window.requestAnimationFrame(this.frame);
      const passed = Math.min((time - this.before) / 1000, 0.05);
      this.before = time;
      if (passed > 0) this.advance(passed);
    };
  }

  get isPlaying() {
    return this.request !== 0;
  }

  play() {
    if (this.isPlaying) return;
    this.before = performance.now();
    this.request = window.requestAnimationFrame(this.frame);
  }

  pause() {
    window.cancelAnimationFrame(this.request);
    this.request = 0;
  }
}
