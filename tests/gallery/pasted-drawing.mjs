// A drawing to paste, with its outlines as drawn by Chromium and as read by the page.

/** A drawing with transforms of every kind, and outlines of every kind. */
export const DRAWING = `<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" stroke="black">
  <defs><path id="loop" d="M0 0C30-40 80-10 50 20S-20 30 0 0Z"/></defs>
  <g transform="translate(40 30) rotate(-20)"><g transform="matrix(1.2 .3 -.4 .8 10 5),scale(1.5,.7)">
    <path transform="skewX(15)"
      d="M5 5h40v12q8 20-16 24t-20 9a12 7 30 1 0-9-8z"/>
    <rect x="3" y="60" width="50" height="30" rx="8" ry="40"/></g>
    <ellipse cx="90" cy="50" rx="40" ry="12" transform="rotate(35 90 50) skewY(-10)"/></g>
  <g transform="scale(-1 1) translate(-300)"><circle cx="40" cy="160" r="9mm"/>
    <polygon points="10,200 60,210 30,260"/><polyline points="100 200,120,240 180 190" fill="none"/>
    <line x1="5" y1="5" x2="2cm" y2="40"/>
    <use xlink:href="#loop" x="200" y="90" transform="rotate(10) scale(.8 2)"/></g>
</svg>`;

/** The boxes of the outlines of a drawing as Chromium draws it, [[x0, y0, x1, y1], …]. */
export function browserBoxes(page, svg) {
  return page.evaluate((text) => {
    const holder = document.createElement("div");
    holder.innerHTML = text;
    document.body.append(holder);
    const shapes = holder.querySelectorAll(
      "svg > g :is(path, rect, ellipse, circle, polygon, polyline, line, use)",
    );
    return [...shapes].map((shape) => {
      const isUse = shape.localName === "use";
      const path = isUse ? holder.querySelector(shape.getAttribute("xlink:href")) : shape;
      const at = isUse ? new DOMPoint(+shape.getAttribute("x"), +shape.getAttribute("y")) : new DOMPoint();
      const length = path.getTotalLength();
      const places = Array.from({ length: 2001 }, (_, k) => {
        const { x, y } = path.getPointAtLength((k / 2000) * length);
        return new DOMPoint(x + at.x, y + at.y).matrixTransform(shape.getCTM());
      });
      const [xs, ys] = [places.map(({ x }) => x), places.map(({ y }) => y)];
      return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
    });
  }, svg);
}

/** The same boxes as read by the kernel of the page. */
export function readBoxes(kernel, svg, count) {
  const bytes = Float64Array.from(new TextEncoder().encode(svg));
  return Array.from({ length: count }, (_, k) => {
    const { points } = kernel.call({ method: "read_path", bytes, outline: String(k + 1) });
    // y points up in the page.
    const [xs, ys] = [0, 1].map((axis) =>
      points.filter((_, at) => at % 2 === axis).map((value) => (axis ? -value : value)),
    );
    return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
  });
}
