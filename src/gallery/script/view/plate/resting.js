// When what is being changed is studied: roughly in each frame, and closely when it has rested.

// The time in milliseconds after which a slider has rested.
const REST_MILLISECONDS = 160;

/** Calls `study(isRough)` for changes, and marks an element as busy until they have rested. */
export class Resting {
  resting = 0;
  waiting = 0;

  /** @param {HTMLElement} element @param {(isRough: boolean) => void} study */
  constructor(element, study) {
    this.element = element;
    this.study = study;
  }

  /** After a change, of which more may follow. */
  changed() {
    this.soon(REST_MILLISECONDS);
    // At most one study per frame.
    this.waiting ||= window.requestAnimationFrame(() => {
      this.waiting = 0;
      this.study(true);
    });
  }

  /** Rests after a time in milliseconds if nothing follows. */
  soon(/** @type {number} */ after) {
    window.clearTimeout(this.resting);
    this.element.setAttribute("aria-busy", "true");
    this.resting = window.setTimeout(() => this.now(), after);
  }

  now() {
    this.end();
    this.study(false);
  }

  end() {
    window.clearTimeout(this.resting);
    window.cancelAnimationFrame(this.waiting);
    this.waiting = 0;
    this.element.removeAttribute("aria-busy");
  }
}
