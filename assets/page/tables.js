// Tables of whole numbers as stored in the page: base64 of a zlib stream of differences, byte by byte.

function bytesOfBase64(text) {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let k = 0; k < letters.length; ++k) bytes[k] = letters.charCodeAt(k);
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Undoes difference_bytes: each column is the difference from the previous one, the first from the row above. */
function undoDifferences(planes, { rows, columns, bytes }) {
  const count = rows * columns;
  const codes = bytes === 1 ? new Uint8Array(count) : bytes === 2 ? new Uint16Array(count) : new Uint32Array(count);
  for (let plane = 0; plane < bytes; ++plane)
    for (let k = 0, at = plane * count; k < count; ++k, ++at) codes[k] |= planes[at] << (8 * plane);
  for (let row = 0; row < rows; ++row) {
    const first = row * columns;
    if (row > 0 && columns > 0) codes[first] += codes[first - columns];
    for (let k = first + 1; k < first + columns; ++k) codes[k] += codes[k - 1];
  }
  return codes;
}

/** Returns the table of an entry of the data, and removes its text, which is large. */
async function readTable(entry) {
  const holder = byId(`table-${entry.name}`);
  const planes = await inflate(bytesOfBase64(holder.textContent));
  holder.textContent = "";
  if (planes.length !== entry.rows * entry.columns * entry.bytes)
    throw new Error(`the table ${entry.name} is incomplete: the page was truncated or changed`);
  return { ...entry, codes: undoDifferences(planes, entry) };
}
