// The pieces of a family's data, and which of them contains a cell, a curve or a page.

/** The pieces of a series, from the index in the head of a family; pages are counted from 1. */
export class Series {
  /** @param {string} id @param {"table" | "curves"} name @param {PieceEntry[]} entries */
  constructor(id, name, entries) {
    let [firstCell, firstCurve, firstPage] = [0, 0, 1];
    /** @type {Piece[]} */ this.pieces = entries.map(({ bytes, cells, curves, pages = 0, numbers }, k) => {
      const number = k + 1;
      const file = `${id}/gallery-${name}-${String(number).padStart(4, "0")}.js`;
      const first = { firstCell, firstCurve, firstPage };
      firstCell += cells;
      firstCurve += curves;
      firstPage += pages;
      const state = { data: null, loading: null, holds: 0 };
      return { name, number, file, bytes, cells, curves, pages, numbers, ...first, ...state };
    });
    this.withCells = this.pieces.filter(({ cells }) => cells > 0);
    this.cells = firstCell;
    this.curves = firstCurve;
    this.pages = firstPage - 1;
    this.bytes = this.pieces.reduce((sum, { bytes }) => sum + bytes, 0);
  }

  /** The piece with a cell, by its index. */
  ofCell(/** @type {number} */ cell) {
    return pieceAt(this.pieces, "firstCell", "cells", cell);
  }

  /** The piece with a curve, by its index. */
  ofCurve(/** @type {number} */ curve) {
    return pieceAt(this.pieces, "firstCurve", "curves", curve);
  }

  /** The piece with a page, numbered from 1. */
  ofPage(/** @type {number} */ page) {
    return pieceAt(this.pieces, "firstPage", "pages", page);
  }

  /** The piece with the cell of a number, if there is such a cell. */
  ofNumber(/** @type {number} */ number) {
    const { withCells } = this;
    const piece = withCells[upperBound(withCells.length, (k) => withCells[k].numbers[0] <= number) - 1];
    return piece && number <= piece.numbers[1] ? piece : undefined;
  }

  /** The number of loaded pieces before the first that is not. */
  get loadedPieces() {
    const end = this.pieces.findIndex(({ data }) => data === null);
    return end < 0 ? this.pieces.length : end;
  }
}

/**
 * The piece whose range of cells, curves or pages contains a number; pieces without any are skipped.
 * @param {Piece[]} pieces @param {"firstCell" | "firstCurve" | "firstPage"} first
 * @param {"cells" | "curves" | "pages"} count @param {number} at
 */
function pieceAt(pieces, first, count, at) {
  // Of pieces with the same first number, only the last is not empty.
  const piece = pieces[upperBound(pieces.length, (k) => pieces[k][first] <= at) - 1];
  return piece && at < piece[first] + piece[count] ? piece : undefined;
}

/** The number of leading indices below `count` for which a condition holds that fails for all after them. */
export function upperBound(/** @type {number} */ count, /** @type {(k: number) => boolean} */ holds) {
  let [low, high] = [0, count];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (holds(middle)) low = middle + 1;
    else high = middle;
  }
  return low;
}
