#!/usr/bin/env bash
# The decoder of npm's meshoptimizer 1.0.1 (WebAssembly), which three.js and glTF-Transform take, returns other values than its encoder
# was given at level 3: channels of four bytes that are rotated. The reference decoder of the same package returns the right ones; so
# does 1.3.0.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
command -v npm > /dev/null && command -v node > /dev/null || { echo "needs node and npm"; exit 77; }
npm install --prefix . --no-audit --no-fund --silent meshoptimizer@1.0.1 || { echo "cannot be had"; exit 77; }
cat > decode.mjs <<'JS'
import { MeshoptEncoder as encoder, MeshoptDecoder as decoder } from 'meshoptimizer';
import { MeshoptDecoder as reference } from './node_modules/meshoptimizer/meshopt_decoder_reference.js';
await encoder.ready; await decoder.ready;
const count = 40, stride = 12, values = new Float32Array(3 * count);
for (let i = 0; i < count; ++i) values.set([i * 0.25, (i % 7) * 0.5 - 1, ((i * i) % 11) * 0.125], 3 * i);
const wrong = (by, packed) => {
  const bytes = new Uint8Array(count * stride);
  by.decodeVertexBuffer(bytes, count, stride, packed);
  return new Float32Array(bytes.buffer).filter((value, i) => value !== values[i]).length;
};
for (const level of [2, 3]) {
  const packed = encoder.encodeVertexBufferLevel(new Uint8Array(values.buffer), count, stride, level, 1);
  console.log('level', level, 'wrong', wrong(decoder, packed), 'by the reference', wrong(reference, packed));
}
JS
result=$(node decode.mjs)
echo "$result"
grep -q "level 2 wrong 0 by the reference 0" <<< "$result" && grep -Eq "level 3 wrong [1-9][0-9]* by the reference 0" <<< "$result" ||
  { echo "CHANGED"; exit 1; }
