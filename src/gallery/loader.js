// Unpacks the page's script, which is compressed in the page, and runs it. The policy allows it by its digest.
const root = document.getElementById("gallery");
if (typeof DecompressionStream === "function") {
  const packed = atob(document.getElementById("script").textContent);
  const bytes = Uint8Array.from(packed, (c) => c.charCodeAt(0));
  const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const script = document.createElement("script");
  script.type = "module";
  script.textContent = await new Response(unpacked).text();
  document.head.append(script);
} else
  root.textContent =
    "The gallery needs a browser of 2023 or later. The pages are in the folders next to this file.";
