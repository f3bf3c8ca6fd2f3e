// Reads a path that is chosen, dropped or pasted, in the kernel and by the code of `find`.

import { buttonOf, fill, h } from "../dom.js";

const MAX_BYTES = 16e6;
const FORMATS = ".csv,.tsv,.txt,.json,.svg,.dxf,.dat";

/** The fields for a path; what is dropped on the view, or pasted into it outside a field, is read as well. */
export class PathField {
  /** The last file, of which another outline may be taken. @type {{ bytes: Uint8Array, name: string } | null} */ file =
    null;

  /** Calls `use(outline, name)` with a path that has been read. @param {App} app @param {(outline: Outline, name: string) => void} use */
  constructor(app, use) {
    this.app = app;
    this.use = use;
    this.said = h("p.note");
    this.wrong = h("p.error", { role: "alert" });
    const file = h("input", { id: "shape-file", type: "file", accept: FORMATS });
    file.onchange = () => {
      const [chosen] = file.files ?? [];
      if (chosen) this.#open(chosen, chosen.name);
      file.value = "";
    };
    const example = "x,y lines, JSON, points.csv, a drawing in SVG or DXF, or path data: M0 0 C…";
    const text = h("textarea", { id: "shape-text", rows: 3, spellcheck: "false", placeholder: example });
    this.outline = h("input", { placeholder: "Outline", "aria-label": "Outline", size: 8, hidden: true });
    this.outline.onchange = () => this.read();
    const readText = () => this.readText(text.value);
    this.element = h(
      "div.field",
      h("label", { for: "shape-file" }, "Choose a file, drop or paste it"),
      file,
      h("label", { for: "shape-text" }, "Paste points or a path"),
      text,
      h("div", buttonOf("Use pasted shape", readText)),
      this.said,
      this.outline,
      this.wrong,
    );
  }

  /** Reads what is dropped on an element, or pasted into it. @param {HTMLElement} element */
  listen(element) {
    const take = (/** @type {Event} */ event, /** @type {DataTransfer | null} */ data) => {
      const [file] = data?.files ?? [];
      const text = data?.getData("text/plain");
      const isField = event.target instanceof Element && event.target.closest("input, textarea");
      if ((!file && !text) || isField) return;
      event.preventDefault();
      if (file) this.#open(file, file.name);
      else if (text) this.readText(text);
    };
    element.addEventListener("dragover", (event) => event.preventDefault());
    element.addEventListener("drop", (event) => take(event, event.dataTransfer));
    element.addEventListener("paste", (event) => take(event, event.clipboardData));
  }

  readText(/** @type {string} */ text) {
    this.#open(new Blob([text]), "the pasted path");
  }

  async #open(/** @type {Blob} */ blob, /** @type {string} */ name) {
    if (blob.size > MAX_BYTES) return void fill(this.wrong, `${name} has more than 16 MB`);
    this.file = { bytes: new Uint8Array(await blob.arrayBuffer()), name };
    this.outline.value = "";
    return this.read();
  }

  /** Reads the file; of several outlines the chosen one, or the most likely. */
  async read() {
    if (!this.file) return;
    const { bytes, name } = this.file;
    const request = {
      method: "read_path",
      bytes: Float64Array.from(bytes),
      outline: this.outline.value.trim() || null,
    };
    try {
      const { curveSearch } = await this.app.kernel.load();
      const { points, closed, taken } = await curveSearch.call(request);
      fill(this.wrong);
      fill(this.said, `${name}: ${taken}`);
      this.outline.hidden = !taken.includes("takes another") && !request.outline;
      this.app.announce(`${name} read: ${taken}`);
      this.use({ points, closed }, name);
    } catch (error) {
      fill(this.wrong, `${name}: ${error.message}`);
    }
  }
}
