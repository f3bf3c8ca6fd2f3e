// Tests filters, counts, histograms and orders: node tests/gallery/find.mjs ATLAS…

import assert from "node:assert/strict";

import { measureValue } from "../../src/gallery/script/data/family.js";
import { filterColumns } from "../../src/gallery/script/find/columns.js";
import { Filters } from "../../src/gallery/script/find/filter.js";
import { BINS, binCounts, histogramOf } from "../../src/gallery/script/find/histogram.js";
import { Orders, passingRows } from "../../src/gallery/script/find/filter.js";
import { formatFindQuery, parseFindQuery } from "../../src/gallery/script/find/query.js";
import { CurveTable } from "../../src/gallery/script/find/table.js";
import { address, parseAddress } from "../../src/gallery/script/data/address.js";
import { atlasOf } from "./atlas-data.mjs";

// Scales and bins.

{
  const linear = histogramOf(Float64Array.of(0, 1, 2, 3, NaN, 4));
  assert.equal(linear.isLog, false);
  assert.deepEqual([linear.low, linear.high], [0, 4]);
  assert.equal(
    linear.counts.reduce((sum, count) => sum + count, 0),
    5,
    "missing values are in no bin",
  );
  assert.equal(linear.bins[5], BINS - 1);
  const spread = histogramOf(Float64Array.from({ length: 100 }, (_, k) => 10 ** (k / 20)));
  assert.equal(spread.isLog, true);
  assert.ok(Math.abs(spread.placeOf(spread.valueAt(0.3)) - 0.3) < 1e-12);
  const infinite = histogramOf(Float64Array.of(1, 2, Infinity));
  assert.equal(infinite.high, 2);
  assert.equal(infinite.bins[2], BINS - 1);
  assert.deepEqual([...binCounts(linear, [0, 5])].filter(Boolean), [1, 1]);
  const single = histogramOf(Float64Array.of(5, 5));
  assert.equal(single.counts[0], 2);
}

// Queries and their addresses.

{
  const fragment =
    "#/find?family=evans,watt&class=crank-rocker,double-rocker&mu_worst_deg=30..&length=..2.5e-3&p.a=-1.5..2&sort=-length&show=table";
  const question = parseFindQuery(parseAddress(fragment).query);
  assert.deepEqual(question.families, ["evans", "watt"]);
  assert.deepEqual(question.filters.get("mu_worst_deg"), { low: 30, high: undefined });
  assert.deepEqual(question.filters.get("length"), { low: undefined, high: 0.0025 });
  assert.deepEqual(question.filters.get("p.a"), { low: -1.5, high: 2 });
  assert.deepEqual([...question.filters.get("class")], ["crank-rocker", "double-rocker"]);
  assert.deepEqual(question.sort, { name: "length", down: true });
  const again = parseFindQuery(parseAddress(address(["find"], formatFindQuery(question))).query);
  assert.deepEqual(again, question);
  assert.equal(parseFindQuery(parseAddress("#/find").query).families, null);
}

// Filters of atlases, compared with a direct computation.

for (const folder of process.argv.slice(2)) {
  const { data, families } = atlasOf(folder);
  const table = new CurveTable(families);
  assert.equal(
    table.count,
    data.families.reduce((sum, { curves }) => sum + curves, 0),
  );
  const columns = filterColumns(table, data.measures);
  const numbers = columns.filter(({ kind }) => kind === "numbers");
  const filters = new Filters(table);
  const at = (row, name) => measureValue(families[table.family[row]], table.curve[row], name);
  const rows = Array.from({ length: table.count }, (_, row) => row);

  filters.set("mu_worst_deg", { low: 30 });
  const wanted = rows.filter((row) => at(row, "mu_worst_deg") >= 30);
  assert.deepEqual([...filters.rows()], wanted, "missing measures are left out");
  assert.ok(wanted.length > 0 && wanted.length < table.count);
  filters.set("class", new Set(["crank-rocker"]));
  assert.deepEqual(
    [...filters.rows()],
    wanted.filter((row) => at(row, "class") === "crank-rocker"),
  );
  const { values } = table.words("class");
  const counts = filters.wordCounts("class");
  values.forEach((word, k) =>
    assert.equal(counts[k], wanted.filter((row) => at(row, "class") === word).length, word),
  );
  filters.set("mu_worst_deg", null);
  filters.set("class", null);
  assert.equal(filters.rows().length, table.count);
  filters.set("straight_tolerance", { high: 0.0005 });
  const straight = (row) => at(row, "straight_deviation") / at(row, "straight_length") <= 0.0005;
  assert.deepEqual([...filters.rows()], rows.filter(straight));

  const orders = new Orders(table);
  for (const down of [false, true]) {
    const order = orders.by("length", "numbers", down);
    const lengths = Array.from(order, (row) => table.numbers("length")[row]);
    const there = lengths.filter((value) => !Number.isNaN(value));
    assert.deepEqual(lengths.slice(0, there.length), there, "what is missing comes last");
    there.slice(1).forEach((value, k) => assert.ok(down ? value <= there[k] : value >= there[k]));
    assert.equal(new Set(order).size, table.count);
  }
  const scales = numbers.map(({ name }) => histogramOf(table.numbers(name)));
  const times = [];
  for (let k = 0; k < 40; k += 1) {
    const began = performance.now();
    filters.set("mu_worst_deg", { low: k });
    const left = filters.rows();
    passingRows(orders.by("length", "numbers", true), filters.failing);
    for (const scale of scales) binCounts(scale, left);
    for (const name of ["class", "symmetric", "is_full_turn"]) filters.wordCounts(name);
    times.push(performance.now() - began);
  }
  times.sort((a, b) => a - b);
  console.log(
    `${folder}: ${table.count} curves, ${columns.length} columns; a filter in ${times[20].toFixed(1)} ms, at most ${times[39].toFixed(1)}`,
  );
}
console.log("find: as it should be");
