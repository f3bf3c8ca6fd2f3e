// Saves files with the browser's download.

/** Saves { name, type, bytes }. */
export function saveFile({ name, type, bytes }) {
  const url = URL.createObjectURL(new Blob([bytes], { type }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  // The browser has read the object by then.
  setTimeout(() => URL.revokeObjectURL(url), 60000);
}
