// Unpacks the page's style sheet and its script, which are compressed in the page. The policy allows them by their digests.
const root = document.getElementById("gallery");
const add = async (/** @type {string} */ id, /** @type {HTMLElement} */ element) => {
  const packed = atob(document.getElementById(id)?.textContent ?? "");
  const bytes = Uint8Array.from(packed, (c) => c.charCodeAt(0));
  const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  element.textContent = await new Response(unpacked).text();
  document.head.append(element);
};
if (typeof DecompressionStream === "function") {
  await add("style", document.createElement("style"));
  const script = document.createElement("script");
  script.type = "module";
  await add("script", script);
} else if (root)
  root.textContent =
    "This page needs a browser of 2023 or later. An atlas has its pages in the folders next to it.";
