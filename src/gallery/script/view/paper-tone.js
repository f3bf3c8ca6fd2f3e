// Pages of dark paper, which the dark has no need to turn.

// Paper of less relative luminance than this has light ink on it: black and white are as far from it, by
// WCAG.
const DARK_LUMINANCE = 0.18;

/** "dark" where a family's pages are of dark paper, or else null: what data-paper says of their pictures. */
export function paperTone({ paper }) {
  const digits = /^#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})$/i.exec(paper.color ?? "");
  if (!digits) return null;
  const [red, green, blue] = digits.slice(1).map((pair) => linearLight(parseInt(pair, 16) / 255));
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue < DARK_LUMINANCE ? "dark" : null;
}

/** The light of a level of sRGB, both from 0 to 1. */
function linearLight(level) {
  return level <= 0.04045 ? level / 12.92 : ((level + 0.055) / 1.055) ** 2.4;
}
