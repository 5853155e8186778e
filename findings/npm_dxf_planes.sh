#!/usr/bin/env bash
# Two packages of npm lose the plane of a DXF's entities (extrusion (0, 0, -1), as mirrored blocks have them). dxf 5.2.0 mirrors arcs
# and circles, but neither LWPOLYLINE nor POLYLINE, and mirrors ELLIPSE, which is given in world coordinates. dxf-parser 1.1.2 hands
# the extrusion of LINE and LWPOLYLINE on, and drops that of CIRCLE, ELLIPSE and TEXT: their places cannot be known.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
command -v npm > /dev/null && command -v node > /dev/null || { echo "needs node and npm"; exit 77; }
npm install --prefix . --no-audit --no-fund --silent dxf@5.2.0 dxf-parser@1.1.2 || { echo "cannot be had"; exit 77; }
plane=(210 0 220 0 230 -1)
printf '%s\n' 0 SECTION 2 HEADER 9 '$ACADVER' 1 AC1015 0 ENDSEC 0 SECTION 2 ENTITIES \
  0 LINE 8 0 10 1 20 2 30 0 11 3 21 4 31 0 "${plane[@]}" \
  0 CIRCLE 8 0 10 10 20 5 30 0 40 2 "${plane[@]}" \
  0 ELLIPSE 8 0 10 10 20 5 30 0 11 3 21 0 31 0 "${plane[@]}" 40 0.5 41 0 42 6.283185307179586 \
  0 LWPOLYLINE 8 0 90 3 70 0 10 1 20 1 10 4 20 1 10 4 20 3 "${plane[@]}" \
  0 TEXT 8 0 10 1 20 2 30 0 40 1 1 A "${plane[@]}" \
  0 ENDSEC 0 EOF > plane.dxf
cat > read.js <<'JS'
const text = require('fs').readFileSync('plane.dxf', 'utf8');
const {Helper} = require('dxf'), Parser = require('dxf-parser');
const middle = points => { const xs = points.map(p => p[0]); return ((Math.min(...xs) + Math.max(...xs)) / 2).toFixed(1); };
const drawn = new Helper(text).toPolylines().polylines.filter(line => line.vertices.length > 1).map(line => middle(line.vertices));
console.log('dxf, middles in x of LINE CIRCLE ELLIPSE LWPOLYLINE:', drawn.join(' '), '(expected 2.0 -10.0 10.0 -2.5)');
const entities = new (Parser.DxfParser || Parser)().parseSync(text).entities;
const kept = entities.filter(e => e.extrusionDirection || e.extrusionDirectionZ !== undefined).map(e => e.type);
console.log('dxf-parser, extrusion of:', kept.join(' '), '(expected LINE CIRCLE ELLIPSE LWPOLYLINE TEXT)');
process.exit(drawn.join(' ') === '2.0 -10.0 -10.0 2.5' && kept.join(' ') === 'LINE LWPOLYLINE' ? 0 : 1);
JS
node read.js || { echo "CHANGED"; exit 1; }
