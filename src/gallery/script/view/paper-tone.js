// Detects pages of dark paper, which need no inversion in the dark theme.

// Paper of lower relative luminance has light ink: this value has equal WCAG contrast to black and white.
const DARK_LUMINANCE = 0.18;

/** The `data-paper` attribute of a family's pictures: "dark" for dark paper, otherwise null. */
export function paperTone({ paper }) {
  const digits = /^#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})$/i.exec(paper.color ?? "");
  if (!digits) return null;
  const [red, green, blue] = digits.slice(1).map((pair) => linearLight(parseInt(pair, 16) / 255));
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue < DARK_LUMINANCE ? "dark" : null;
}

/** The linear light of an sRGB level, both from 0 to 1. */
function linearLight(level) {
  return level <= 0.04045 ? level / 12.92 : ((level + 0.055) / 1.055) ** 2.4;
}
