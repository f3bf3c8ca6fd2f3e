// The pieces of a family's data, and which of them contains a cell, a curve or a page.

/**
 * The pieces of a series, "table" or "curves", from the index in the head of a family: [{ name, number, file,
 * bytes, cells, curves, pages, numbers (of the first and the last cell), firstCell, firstCurve, firstPage,
 * data, loading, holds }], with `data` null until the piece is loaded. First pages count from 1.
 */
export class Series {
  constructor(id, name, entries) {
    let [firstCell, firstCurve, firstPage] = [0, 0, 1];
    this.pieces = entries.map((entry, k) => {
      const { bytes, cells, curves, pages = 0, numbers } = entry;
      const number = k + 1;
      const file = `${id}/gallery-${name}-${String(number).padStart(4, "0")}.js`;
      const state = { data: null, loading: null, holds: 0 };
      const piece = { name, number, file, bytes, cells, curves, pages, numbers, ...state };
      Object.assign(piece, { firstCell, firstCurve, firstPage });
      firstCell += cells;
      firstCurve += curves;
      firstPage += pages;
      return piece;
    });
    this.withCells = this.pieces.filter(({ cells }) => cells > 0);
    [this.cells, this.curves, this.pages] = [firstCell, firstCurve, firstPage - 1];
    this.bytes = this.pieces.reduce((sum, { bytes }) => sum + bytes, 0);
  }

  /** The piece with a cell, by its index. */
  ofCell(cell) {
    return pieceAt(
      this.pieces,
      (piece) => piece.firstCell,
      (piece) => piece.cells,
      cell,
    );
  }

  /** The piece with a curve, by its index. */
  ofCurve(curve) {
    return pieceAt(
      this.pieces,
      (piece) => piece.firstCurve,
      (piece) => piece.curves,
      curve,
    );
  }

  /** The piece with a page, numbered from 1. */
  ofPage(page) {
    return pieceAt(
      this.pieces,
      (piece) => piece.firstPage,
      (piece) => piece.pages,
      page,
    );
  }

  /** The piece with the cell of a number, if there is such a cell. */
  ofNumber(number) {
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
 * The piece whose range, from `first` on and `count` long, contains a number; pieces without any are skipped.
 */
function pieceAt(pieces, first, count, at) {
  // Of pieces with the same first number, only the last is not empty.
  const piece = pieces[upperBound(pieces.length, (k) => first(pieces[k]) <= at) - 1];
  return piece && at < first(piece) + count(piece) ? piece : undefined;
}

/** The number of leading indices below `count` for which a condition holds that fails for all after them. */
export function upperBound(count, holds) {
  let [low, high] = [0, count];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (holds(middle)) low = middle + 1;
    else high = middle;
  }
  return low;
}
