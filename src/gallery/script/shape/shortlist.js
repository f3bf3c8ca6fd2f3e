// Keeps the best few of many offers.

/** The `most` offers with the greatest `value`. */
export class Shortlist {
  constructor(most) {
    this.most = most;
    this.kept = [];
  }

  /** The value that an offer must exceed to be kept. */
  least() {
    return this.kept.length < this.most ? -Infinity : this.kept[this.kept.length - 1].value;
  }

  offer(one) {
    if (!(one.value > this.least())) return;
    let at = this.kept.length;
    while (at > 0 && this.kept[at - 1].value < one.value) at -= 1;
    this.kept.splice(at, 0, one);
    if (this.kept.length > this.most) this.kept.pop();
  }

  /** The kept offers, the best first. */
  best() {
    return this.kept;
  }
}
