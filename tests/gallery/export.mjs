// Compares the page's exports with the program's, byte for byte: node tests/gallery/export.mjs PROGRAM
//
// PROGRAM is the binary. Renders atlases with a linkage for each kind of joint, in two themes, and exports curves by
// the page's menu and by the program's command `export`. See browser.mjs for the environment.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";

import { openGallery, runTests } from "./browser.mjs";
import { filesOfZip } from "./export-data.mjs";

const program = resolve(process.argv.slice(2).at(-1));

const THEMES = ['"paper"', '{ base = "dark", face = "sans", weights = 1.2, lettering = 1.1 }'];

/** A linkage of its own, with a parameter that a cell need not give. */
const OWN_LINKAGE = `
[[linkage]]
id = "own"
parameters = { d = { default = 1, min = 0 } }
trace = ["M"]
[linkage.joints]
O = { fixed = [0, 0] }
C = { fixed = ["3 * d", 0] }
A = { crank = "O", length = "d" }
B = { dyad = ["A", "C"], lengths = [3, 2.5], side = "left" }
M = { point = ["A", "B"], distances = [1.3, 2.1], side = "left" }
`;

const families = (manifest) =>
  [...manifest.matchAll(/^\[\[family\]\]\n([\s\S]*?)(?=^\[|$(?![\s\S]))/gm)].map(([, text]) => text);

/** The first family of each linkage of atlas.toml, with the curves of its pages. */
function manifestOf(theme) {
  const atlas = readFileSync(new URL("../../atlas.toml", import.meta.url), "utf8");
  const seen = new Set();
  const chosen = families(atlas).filter((text) => {
    const [, linkage] = /^linkage = "(.*)"$/m.exec(text);
    return !seen.has(linkage) && seen.add(linkage);
  });
  const head = `[atlas]\ntitle = "Exports"\noutput = "out"\n[page]\ntheme = ${theme}\n`;
  const own = `[[family]]\nid = "own"\nlinkage = "own"\nsampling = { samples = 90 }\ncircuits = "all"\ncolumns = ["vx", "curvature"]\ncases = [{ d = 1.05 }, {}]\n`;
  const linkages = atlas.slice(atlas.indexOf("[[linkage]]"));
  return [head, OWN_LINKAGE, linkages, ...chosen.map((text) => `[[family]]\n${text}\n`), own].join("\n");
}

/** The names of the first and the last curve of each family in a folder, and of changed ones. */
function namesIn(folder) {
  const { families: listed } = JSON.parse(readFileSync(join(folder, "run.json"), "utf8"));
  const named = listed.flatMap(({ id }) => {
    const rows = readFileSync(join(folder, id, "points.csv"), "utf8")
      .trimEnd()
      .split("\n")
      .slice(1);
    const key = (row) => row.split(",", 3).join(".");
    return rows.length ? [...new Set([key(rows[0]), key(rows.at(-1))])].map((own) => `${id}:${own}`) : [];
  });
  return [
    ...named,
    "evans:1.1.1?p=2.5&M.along=3",
    "evans:2.1.1?circuit=2",
    "hrones-nelson:1.3.1?M.across=0.37",
    "own:1.1.1?d=1.1",
  ];
}

const LABELS = {
  svg: "SVG static",
  "moving-svg": "Animated SVG .svg",
  dxf: "DXF CAD, AutoCAD R12",
  csv: "CSV points",
  json: "JSON all data",
  toml: "Manifest fragment .toml",
};

async function saved(page, label) {
  await page.click(".export-button");
  const [download] = await Promise.all([
    page.waitForEvent("download", { timeout: 60000 }),
    page.locator(".export-menu").getByRole("menuitem", { name: label, exact: true }).click(),
  ]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

const tests = THEMES.map((theme, k) => [
  `8.${k + 1}`,
  `the page's exports are the program's, with the theme ${theme}`,
  async ({ browser }) => {
    const folder = mkdtempSync(join(tmpdir(), "exports-"));
    const run = (...words) =>
      execFileSync(program, words, { cwd: folder, stdio: ["ignore", "ignore", "inherit"] });
    try {
      writeFileSync(join(folder, "atlas.toml"), manifestOf(theme));
      run("render", "--format", "svg", "--quiet");
      const names = namesIn(join(folder, "out"));
      run("export", ...names, "--format", Object.keys(LABELS).join(","), "-o", "taken");
      const fragment = names.map(encodeURIComponent).join(",");
      const { page, close } = await openGallery(browser, join(folder, "out"), `/compare?c=${fragment}`, {
        acceptDownloads: true,
      });
      await page.waitForSelector(".export-button");
      const differing = [];
      let count = 0;
      for (const [format, label] of Object.entries(LABELS)) {
        const { name, bytes } = await saved(page, label);
        const files = name.endsWith(".zip") ? filesOfZip(new Uint8Array(bytes)) : [{ name, bytes }];
        assert.equal(files.length, format === "toml" ? 1 : names.length, format);
        for (const file of files) {
          const theirs = join(folder, "taken", file.name);
          const isSame = existsSync(theirs) && readFileSync(theirs).equals(Buffer.from(file.bytes));
          if (!isSame) differing.push(file.name);
          if (!isSame && process.env.KEEP) writeFileSync(join(process.env.KEEP, file.name), file.bytes);
          count += 1;
        }
      }
      console.log(`   ${count} files`);
      assert.deepEqual(
        differing,
        [],
        `of ${count} files, and the program's are ${readdirSync(join(folder, "taken"))}`,
      );
      await close();
    } finally {
      if (!process.env.KEEP) rmSync(folder, { recursive: true });
    }
  },
]);

await runTests(tests);
