/** A picture as OpenEXR: one part, scan lines, 32-bit floats, not compressed. */

const FLOAT = 2;

/** The file of a picture of linear sRGB, rows from the top. */
export function exr(width: number, height: number, colour: Float32Array): Uint8Array<ArrayBuffer> {
  const head = header(width, height);
  const row = 8 + 12 * width;
  const bytes = new Uint8Array(head.length + 8 * height + row * height);
  bytes.set(head);
  const view = new DataView(bytes.buffer);
  for (let y = 0; y < height; y++) {
    const at = head.length + 8 * height + row * y;
    view.setBigUint64(head.length + 8 * y, BigInt(at), true);
    view.setInt32(at, y, true);
    view.setInt32(at + 4, 12 * width, true);
    // Channels by their names: B, G, R.
    for (let k = 0; k < 3; k++) {
      for (let x = 0; x < width; x++) view.setFloat32(at + 8 + 4 * (k * width + x), colour[3 * (y * width + x) + 2 - k] as number, true);
    }
  }
  return bytes;
}

function header(width: number, height: number): Uint8Array {
  const bytes: number[] = [0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0];
  const text = (s: string) => bytes.push(...new TextEncoder().encode(s), 0);
  const words = (...values: number[]) => bytes.push(...new Uint8Array(new Int32Array(values).buffer));
  const float = (x: number) => bytes.push(...new Uint8Array(new Float32Array([x]).buffer));
  const attribute = (name: string, type: string, size: number) => {
    text(name);
    text(type);
    words(size);
  };
  attribute('channels', 'chlist', 3 * 18 + 1);
  for (const name of ['B', 'G', 'R']) {
    text(name);
    words(FLOAT, 0, 1, 1);
  }
  bytes.push(0);
  attribute('compression', 'compression', 1);
  bytes.push(0);
  for (const name of ['dataWindow', 'displayWindow']) {
    attribute(name, 'box2i', 16);
    words(0, 0, width - 1, height - 1);
  }
  attribute('lineOrder', 'lineOrder', 1);
  bytes.push(0);
  attribute('pixelAspectRatio', 'float', 4);
  float(1);
  attribute('screenWindowCenter', 'v2f', 8);
  float(0);
  float(0);
  attribute('screenWindowWidth', 'float', 4);
  float(1);
  bytes.push(0);
  return new Uint8Array(bytes);
}
