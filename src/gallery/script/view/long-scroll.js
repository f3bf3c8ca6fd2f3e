// Lists that are higher than a browser can make an element.

/** The greatest height of an element, in pixels: Firefox allows 17.9 million, Chromium 33.5 million. */
export const MAX_HEIGHT = 15e6;

/**
 * The pixels of content per pixel scrolled, of a list of a height in a window: 1, unless the list is too
 * high. Its element then has the greatest height, and scrolling moves the content faster.
 */
export function scrollScale(height, windowHeight) {
  return height <= MAX_HEIGHT ? 1 : (height - windowHeight) / (MAX_HEIGHT - windowHeight);
}
