// Transformation from mean diameters in the frame of the bed to pixels of the page: a clockwise turn, then a scale.

const camera = { scale: 1, originX: 0, originY: 0, turn: 0 };

function project(x, y) {
  const c = Math.cos(camera.turn), s = Math.sin(camera.turn);
  return [camera.originX + camera.scale * (c * x + s * y), camera.originY - camera.scale * (c * y - s * x)];
}

function unproject(px, py) {
  const c = Math.cos(camera.turn), s = Math.sin(camera.turn);
  const along = (px - camera.originX) / camera.scale, up = (camera.originY - py) / camera.scale;
  return [c * along - s * up, s * along + c * up];
}

const margin = 0.75;  // D, space around the bed that shows its periodic images

/** Returns the bounding box of the bed at a turn, in the turned frame, D. */
function boxAt(turn) {
  const c = Math.cos(turn), s = Math.sin(turn);
  const xs = [], ys = [];
  for (const x of [-margin, bed.length + margin])
    for (const y of [bed.low - 0.3, bed.high + 0.3]) {
      xs.push(c * x + s * y);
      ys.push(c * y - s * x);
    }
  return { left: Math.min(...xs), right: Math.max(...xs), low: Math.min(...ys), high: Math.max(...ys) };
}

/** Sets the camera to show the entire bed in a picture of that size, px. */
function fitCamera(width, height, turn) {
  const box = boxAt(turn);
  camera.turn = turn;
  camera.scale = Math.min(width / (box.right - box.left), height / (box.high - box.low));
  camera.originX = width / 2 - (camera.scale * (box.left + box.right)) / 2;
  camera.originY = height / 2 + (camera.scale * (box.low + box.high)) / 2;
}

/** Turns the bed about the point in the middle of the picture. */
function turnCamera(width, height, turn) {
  const [x, y] = unproject(width / 2, height / 2);
  camera.turn = turn;
  const [px, py] = project(x, y);
  moveCamera(width / 2 - px, height / 2 - py);
}

function moveCamera(dx, dy) {
  camera.originX += dx;
  camera.originY += dy;
}

/** Zooms about a point of the picture, between half the scale of the entire bed (`fitted`) and 200 px per D. */
function zoomCamera(factor, px, py, fitted) {
  const scale = Math.min(Math.max(camera.scale * factor, 0.5 * fitted), Math.max(200, fitted));
  const change = scale / camera.scale;
  camera.originX = px + change * (camera.originX - px);
  camera.originY = py + change * (camera.originY - py);
  camera.scale = scale;
}
