// Reads data from `packing.py`: four bytes with the length of the header, the header as JSON, and the arrays.

const KINDS = { int8: Int8Array, uint8: Uint8Array, uint16: Uint16Array, int32: Int32Array, uint32: Uint32Array };

export function unpacked(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const array = name => {
    const [kind, first, count] = header.arrays[name];
    return new KINDS[kind](buffer, 4 + length + first, count);
  };
  return { header, array };
}

// Convert columns of differences, stored one after another, to rows of `width` 16-bit whole numbers. Sums wrap.
export function rowsOf(steps, width, Kind = Uint16Array) {
  const count = steps.length / width, rows = new Kind(steps.length);
  for (let c = 0; c < width; c++) {
    for (let i = 0, sum = 0; i < count; i++) rows[i * width + c] = sum += steps[c * count + i];
  }
  return rows;
}

// Sum differences whose lowest bit is their sign.
export function summed(zigzag) {
  const values = new Uint32Array(zigzag.length);
  for (let i = 0, sum = 0; i < zigzag.length; i++) values[i] = sum += (zigzag[i] >>> 1) ^ -(zigzag[i] & 1);
  return values;
}
